#pragma once
// A rig's joint rotations in a T-pose: they make the rotations of two rigs comparable, whatever
// their rest poses and local axes.

#include <array>

#include "base/quat.h"
#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

struct ReferencePose {
  // World rotations of the human joints, Y up, in their raw local axes, of the body facing +z with
  // arms along x, legs straight down and feet flat and pointing ahead. A missing joint has its
  // parent's.
  std::array<Quat, kHumanJoints> rotations;
  // Derived from the rest pose, which stands; otherwise from the motion.
  bool from_rest = false;
  float leg = 0, arm = 0;  // Length of a limb, mean of both sides, metres of the rig.
  // Height of the toe joints on the floor, metres of the rig, for the character that takes a motion
  // and for the motion: those of a rest pose near the plane y = 0, if there is one. Otherwise a
  // character stands where its motion's lowest toes are; but the floor of a motion is not there if
  // they stay above that plane, or jumps would start on the ground.
  float rest_toes = 0, motion_toes = 0;
};

// The orientation of a canonical body's torso, from joint positions only: comparable between rigs
// with different spines.
struct TorsoFrames {
  Quat hips;  // World, the identity for a body that stands upright and faces +z.
  // Unit directions from spine to chest, from chest to the middle of the shoulders, and from neck
  // to head.
  Vec3 spine, chest, neck;
};
// positions, facing: as in BodyPose.
TorsoFrames torso_frames(const HumanPositions& positions, float facing);

// Finds the reference pose from the rest pose of `clip`, if it stands, by bringing its limbs into
// the T-pose with the smallest rotations; else from the motion, by the limbs' directions and mean
// twists.
ReferencePose find_reference_pose(const Clip& clip, const Rig& rig);

// t_pose_body.cpp: the humanoid of a rig as a separate skeleton, for formats that hold only
// humanoids. One frame of a body in T-pose on y = 0: metres, facing +z, arms along x, identity rest
// rotations. Its joints are the 21 human joints in order, and three per finger of the rig, with VRM
// names as names and roles; the hips translate. Arms and legs have the rig's lengths in the unit of
// its file; torso and feet are the canonical body's, scaled to the rig's legs.
Clip t_pose_body(const Clip& clip, const Rig& rig);

}  // namespace panache
