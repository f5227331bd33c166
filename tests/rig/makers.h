#pragma once
// Rigs with the names, joints and rest poses of eleven makers.

#include <vector>

#include "rig/canonical_body.h"
#include "rig/made_up.h"

namespace panache::test {

// The pose in which a maker's file has all its rest rotations.
enum class RestPose { t, a, arms_down };
// Where the local axes of its joints point.
enum class Axes {
  world,  // In the rest pose all as the world's, as in BVH files.
  own,    // Somewhere else in every joint, as in Unreal and Rigify.
};

struct Maker {
  const char *name, *left, *right;
  RestPose rest;
  Axes axes;
  double units_per_metre;
  bool z_up;
  float legs, arms, torso;  // Lengths against the canonical body's.
  std::vector<Line> lines;  // They keep the order of the maker.
};

inline const std::vector<Maker>& makers() {
  static const std::vector<Maker> all = {
      {"Mixamo", "Left", "Right", RestPose::t, Axes::world, 100, false, 1.05f, 1, 1, tree(R"(
mixamorig5:Hips, hips = > mixamorig5:Spine, spine 0.5 > mixamorig5:Spine1, spine =
  > mixamorig5:Spine2, chest = > mixamorig5:Neck, neck = > mixamorig5:Head, head =
  > mixamorig5:HeadTop_End, head 3;
mixamorig5:Spine2 > mixamorig5:*Shoulder, leftShoulder = > mixamorig5:*Arm, leftUpperArm =
  > mixamorig5:*ForeArm, leftLowerArm = > mixamorig5:*Hand, leftHand =
  > mixamorig5:*HandThumb1, leftHand 1.1;
mixamorig5:*Hand > mixamorig5:*HandIndex1, leftHand 1.4 > mixamorig5:*HandIndex2, leftHand 1.5;
mixamorig5:Hips > mixamorig5:*UpLeg, leftUpperLeg = > mixamorig5:*Leg, leftLowerLeg =
  > mixamorig5:*Foot, leftFoot = > mixamorig5:*ToeBase, leftToes =
  > mixamorig5:*Toe_End, leftToes 1.5)")},
      {"Unreal 4", "l", "r", RestPose::a, Axes::own, 100, true, 1.1f, 1.05f, 1, tree(R"(
root, hips 0 > pelvis, hips = > spine_01, spine 0.4 > spine_02, spine = > spine_03, chest =
  > clavicle_*, leftShoulder = > upperarm_*, leftUpperArm = > lowerarm_*, leftLowerArm =
  > hand_*, leftHand = > index_01_*, leftHand 1.4;
lowerarm_* > lowerarm_twist_01_*, leftHand 0.5;
upperarm_* > upperarm_twist_01_*, leftLowerArm 0.5;
spine_03 > neck_01, neck = > head, head =;
pelvis > thigh_*, leftUpperLeg = > calf_*, leftLowerLeg = > calf_twist_01_*, leftFoot 0.5;
calf_* > foot_*, leftFoot = > ball_*, leftToes =;
thigh_* > thigh_twist_01_*, leftLowerLeg 0.5;
root > ik_foot_root, hips 0 > ik_foot_*, leftFoot;
root > ik_hand_root, hips 0 > ik_hand_gun, rightHand > ik_hand_*, leftHand)")},
      {"Unreal 5", "l", "r", RestPose::a, Axes::own, 100, true, 1.15f, 1.1f, 1.05f, tree(R"(
root, hips 0 > pelvis, hips = > spine_01, spine 0.3 > spine_02, spine 0.7 > spine_03, spine =
  > spine_04, chest 0.6 > spine_05, chest = > neck_01, neck > neck_02, head 0.5 =neck
  > head, head =;
spine_05 > clavicle_*, leftShoulder = > clavicle_out_*, leftUpperArm 0.8;
clavicle_* > upperarm_*, leftUpperArm = > upperarm_correctiveRoot_*, leftUpperArm;
upperarm_* > upperarm_bicep_*, leftLowerArm 0.4;
upperarm_* > lowerarm_*, leftLowerArm = > hand_*, leftHand = > wrist_inner_*, leftHand 1.02;
hand_* > wrist_outer_*, leftHand 1.02;
hand_* > index_metacarpal_*, leftHand 1.2 > index_01_*, leftHand 1.4;
pelvis > thigh_*, leftUpperLeg = > calf_*, leftLowerLeg = > calf_knee_*, leftLowerLeg;
calf_* > foot_*, leftFoot = > ankle_bck_*, leftFoot;
foot_* > ankle_fwd_*, leftFoot;
foot_* > ball_*, leftToes =;
root > interaction, hips 0;
root > center_of_mass, hips 0)")},
      {"VRM", "L", "R", RestPose::t, Axes::world, 1, false, 0.8f, 0.85f, 0.8f, tree(R"(
Root, hips 0 > J_Bip_C_Hips, hips = > J_Bip_C_Spine, spine = > J_Bip_C_Chest, chest 0.6
  > J_Bip_C_UpperChest, chest = > J_Sec_*_Bust1, leftShoulder;
J_Bip_C_UpperChest > J_Bip_C_Neck, neck = > J_Bip_C_Head, head = > J_Adj_*_FaceEye, head 1.2;
J_Bip_C_Head > J_Sec_Hair1_01, head 4 > J_Sec_Hair2_01, head 6;
J_Bip_C_UpperChest > J_Bip_*_Shoulder, leftShoulder = > J_Bip_*_UpperArm, leftUpperArm =
  > J_Bip_*_LowerArm, leftLowerArm = > J_Bip_*_Hand, leftHand = > J_Bip_*_Index1, leftHand 1.4;
J_Bip_C_Hips > J_Bip_*_UpperLeg, leftUpperLeg = > J_Sec_*_Skirt1, leftLowerLeg 0.3;
J_Bip_*_UpperLeg > J_Bip_*_LowerLeg, leftLowerLeg = > J_Bip_*_Foot, leftFoot =
  > J_Bip_*_ToeBase, leftToes =)")},
      {"SMPL", "L", "R", RestPose::t, Axes::world, 1, false, 1.02f, 1, 1.02f, tree(R"(
Pelvis, hips = > *_Hip, leftUpperLeg = > *_Knee, leftLowerLeg = > *_Ankle, leftFoot =
  > *_Foot, leftToes =;
Pelvis > Spine1, spine 0.6 > Spine2, spine = > Spine3, chest = > Neck, neck = > Head, head =;
Spine3 > *_Collar, leftShoulder = > *_Shoulder, leftUpperArm = > *_Elbow, leftLowerArm =
  > *_Wrist, leftHand = > *_Hand, leftHand 1.3)")},
      {"Rokoko", "Left", "Right", RestPose::t, Axes::world, 100, false, 1.1f, 1.1f, 1.1f, tree(R"(
Root, hips 0 > Hips, hips = > Spine, spine 0.3 > Spine2, spine = > Spine3, chest 0.5
  > Spine4, chest = > Neck, neck = > Head, head =;
Spine4 > *Shoulder, leftShoulder = > *Arm, leftUpperArm = > *ForeArm, leftLowerArm =
  > *Hand, leftHand = > *Digit2Metacarpophalangeal, leftHand 1.4;
Hips > *Thigh, leftUpperLeg = > *Shin, leftLowerLeg = > *Foot, leftFoot = > *Toe, leftToes =
  > *ToeTip, leftToes 1.4)")},
      {"Xsens", "Left", "Right", RestPose::t, Axes::world, 100, true, 1.08f, 1.02f, 1, tree(R"(
Pelvis, hips = > L5, spine 0.3 > L3, spine 0.7 > T12, spine = > T8, chest = > Neck, neck =
  > Head, head =;
T8 > *Shoulder, leftShoulder = > *UpperArm, leftUpperArm = > *ForeArm, leftLowerArm =
  > *Hand, leftHand =;
Pelvis > *UpperLeg, leftUpperLeg = > *LowerLeg, leftLowerLeg = > *Foot, leftFoot =
  > *Toe, leftToes =)")},
      {"Rigify", "L", "R", RestPose::a, Axes::own, 1, true, 1.05f, 1.05f, 1.1f, tree(R"(
root, hips 0 > DEF-spine, hips = > DEF-spine.001, spine 0.5 > DEF-spine.002, spine =
  > DEF-spine.003, chest = > DEF-spine.004, neck 0.7 > DEF-spine.005, neck =
  > DEF-spine.006, head =;
DEF-spine > DEF-pelvis.*, leftUpperLeg 0.4;
DEF-spine.003 > DEF-breast.*, leftShoulder;
DEF-spine.003 > DEF-shoulder.*, leftShoulder = > DEF-upper_arm.*, leftUpperArm =
  > DEF-upper_arm.*.001, leftLowerArm 0.5 > DEF-forearm.*, leftLowerArm =
  > DEF-forearm.*.001, leftHand 0.5 > DEF-hand.*, leftHand = > DEF-f_index.01.*, leftHand 1.4;
DEF-hand.* > DEF-thumb.01.*, leftHand 1.1;
DEF-spine > DEF-thigh.*, leftUpperLeg = > DEF-thigh.*.001, leftLowerLeg 0.5
  > DEF-shin.*, leftLowerLeg = > DEF-shin.*.001, leftFoot 0.5 > DEF-foot.*, leftFoot =
  > DEF-toe.*, leftToes =)")},
      {"Perception Neuron", "Left", "Right", RestPose::t, Axes::world, 100, false, 1.05f, 1, 1.05f,
       tree(R"(
Hips, hips = > *UpLeg, leftUpperLeg = > *Leg, leftLowerLeg = > *Foot, leftFoot =;
Hips > Spine, spine 0.3 > Spine1, spine = > Spine2, chest 0.6 > Spine3, chest = > Neck, neck =
  > Head, head =;
Spine3 > *Shoulder, leftShoulder = > *Arm, leftUpperArm = > *ForeArm, leftLowerArm =
  > *Hand, leftHand = > *HandThumb1, leftHand 1.1;
*Hand > *InHandIndex, leftHand 1.1 > *HandIndex1, leftHand 1.4;
*Hand > *InHandMiddle, leftHand 1.1)")},
      {"3ds Max Biped", "L", "R", RestPose::arms_down, Axes::own, 39.37, true, 1, 1, 1, tree(R"(
Bip01, hips > Bip01 Footsteps, hips 0;
Bip01 > Bip01 Pelvis, hips = > Bip01 Spine, spine 0.3 > Bip01 Spine1, spine =
  > Bip01 Spine2, chest = > Bip01 Neck, neck = > Bip01 Head, head = > Bip01 HeadNub, head 3;
Bip01 Neck > Bip01 * Clavicle, leftShoulder = > Bip01 * UpperArm, leftUpperArm =
  > Bip01 * Forearm, leftLowerArm = > Bip01 * ForeTwist, leftHand 0.5;
Bip01 * Forearm > Bip01 * Hand, leftHand = > Bip01 * Finger0, leftHand 1.1
  > Bip01 * Finger0Nub, leftHand 1.3;
Bip01 Spine > Bip01 * Thigh, leftUpperLeg = > Bip01 * Calf, leftLowerLeg =
  > Bip01 * Foot, leftFoot = > Bip01 * Toe0, leftToes = > Bip01 * Toe0Nub, leftToes 1.2)")},
      {"DAZ", "l", "r", RestPose::a, Axes::world, 100, false, 1.1f, 1.08f, 1.05f, tree(R"(
hip, hips = > pelvis, hips > *ThighBend, leftUpperLeg = > *ThighTwist, leftLowerLeg 0.5
  > *Shin, leftLowerLeg = > *Foot, leftFoot = > *Metatarsals, leftToes 0.4 > *Toe, leftToes =
  > *SmallToe1, leftToes 1.2;
hip > abdomenLower, spine 0.4 > abdomenUpper, spine = > chestLower, chest 0.5 > chestUpper, chest =
  > *Collar, leftShoulder = > *ShldrBend, leftUpperArm = > *ShldrTwist, leftLowerArm 0.5
  > *ForearmBend, leftLowerArm = > *ForearmTwist, leftHand 0.5 > *Hand, leftHand =
  > *Carpal1, leftHand 1.1 > *Index1, leftHand 1.4;
chestUpper > neckLower, neck > neckUpper, head 0.6 =neck > head, head = > lowerJaw, head)")}};
  return all;
}

}  // namespace panache::test
