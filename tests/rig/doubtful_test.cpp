// Rigs that would be torn are rejected.

#include <cmath>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "rig/rig_checks.h"

namespace panache {
namespace {

using namespace test;
using enum HumanJoint;

// The limbs of a rig that Rigify has generated, under `arm` and `leg`.
std::vector<Line> limbs(const std::string& arm, const std::string& leg) {
  return {{"DEF-upper_arm.*", arm, left_upper_arm},
          {"DEF-forearm.*", "DEF-upper_arm.*", left_lower_arm},
          {"DEF-hand.*", "DEF-forearm.*", left_hand},
          {"DEF-thigh.*", leg, left_upper_leg},
          {"DEF-shin.*", "DEF-thigh.*", left_lower_leg},
          {"DEF-foot.*", "DEF-shin.*", left_foot},
          {"DEF-toe.*", "DEF-foot.*", left_toes}};
}

std::string message(std::vector<Line> lines, const std::vector<Line>& more,
                    const RigOptions& options = {}) {
  lines.insert(lines.end(), more.begin(), more.end());
  return rejection_of(make_up(lines, "L", "R").clip(), options);
}

TEST(Doubtful, a_torso_of_controls_with_limbs_that_deform_is_rejected) {
  const std::vector<Line> lines = tree(R"(
root, hips 0 > torso, hips > spine_fk.002, spine > ORG-spine.003, chest > head, head)");
  EXPECT_EQ(message(lines, limbs("ORG-spine.003", "torso")),
            "doubtful: hips would be 'torso', a control, and leftUpperArm 'DEF-upper_arm.L', which "
            "deforms the mesh and does not follow it in the file; expected the joints that deform "
            "the mesh in one hierarchy, a map that says which these are, or the motion styled "
            "where its controls are");
  RigOptions given;
  given.joints[index(hips)] = "torso";
  EXPECT_EQ(message(lines, limbs("ORG-spine.003", "torso"), given), "");
}

TEST(Doubtful, arms_beside_the_spine_are_rejected) {
  const std::vector<Line> spine_alone = tree(R"(
rig, hips > DEF-spine, spine 0.1 > DEF-spine.001, spine 0.5 > DEF-spine.002, spine
  > DEF-spine.003, chest > DEF-spine.004, neck > DEF-spine.006, head)");
  EXPECT_EQ(message(spine_alone, limbs("rig", "rig")),
            "doubtful: leftUpperArm 'DEF-upper_arm.L' does not hang on the spine 'DEF-spine', but "
            "beside it on 'rig'; expected the joints that deform the mesh in one hierarchy, a map "
            "that says which these are, or the motion styled where its controls are");
}

// The same without names that tell: the skin does.
TEST(Doubtful, a_skin_that_the_hips_do_not_move_is_rejected) {
  const std::vector<Line> lines = tree(R"(
root, hips 0 > torso, hips > spine control, spine > chest control, chest > head control, head;
root > belly, spine > breast, chest;
chest control > arm.*, leftUpperArm > forearm.*, leftLowerArm > hand.*, leftHand;
torso > thigh.*, leftUpperLeg > shin.*, leftLowerLeg > foot.*, leftFoot)");
  const auto with_weights = [&](float torso, int skin) {
    Clip clip = make_up(lines, "L", "R").clip();
    for (Joint& joint : clip.skeleton.joints) {
      const bool on_limb = joint.name.ends_with("L") || joint.name.ends_with("R");
      const bool on_torso = joint.name == "belly" || joint.name == "breast";
      if (!on_limb && !on_torso) continue;
      joint.skin = on_torso ? skin : 0;
      joint.skin_weight = on_torso ? torso : 100;
    }
    return rejection_of(clip);
  };
  // 1200 on twelve joints of limbs.
  EXPECT_EQ(
      with_weights(400, 0),
      "doubtful: hips would be 'torso', which does not move 40 % of the mesh of leftUpperArm "
      "'arm.L', such as what follows 'belly'; expected the joints that deform the mesh in one "
      "hierarchy, a map that says which these are, or the motion styled where its controls "
      "are");
  EXPECT_EQ(with_weights(180, 0), "");  // Less than a quarter.
  EXPECT_EQ(with_weights(400, 1), "");  // Another mesh.
}

// Rigify's metarig, left in the file beside a rig that deforms in one hierarchy.
TEST(Doubtful, a_skeleton_that_moves_no_mesh_beside_one_that_does_is_rejected) {
  const std::vector<Line> lines = tree(R"(
metarig, hips 0 > spine, hips > spine.003, chest > head, head;
spine.003 > upper_arm.*, leftUpperArm > forearm.*, leftLowerArm > hand.*, leftHand;
spine > thigh.*, leftUpperLeg > shin.*, leftLowerLeg > foot.*, leftFoot;
rig, hips 0)");
  Clip clip = make_up(lines, "L", "R").clip();
  const auto add = [&](const std::string& name) {
    Joint joint;
    joint.name = name;
    joint.parent = static_cast<int>(clip.joints()) - 1;
    joint.skin = 0;
    joint.skin_weight = 10;
    clip.skeleton.joints.push_back(joint);
    clip.resize(0);
    clip.append(rest_clip(clip.skeleton).pose(0));
  };
  for (int i = 0; i < 10; ++i) add("tail." + std::to_string(i));
  EXPECT_EQ(rejection_of(clip), "");  // A prop.
  add("tail.10");
  EXPECT_EQ(rejection_of(clip),
            "doubtful: hips would be 'spine', which moves no mesh; the mesh follows other joints, "
            "such as 'tail.0'; expected a file without the skeleton that moves none, or a map");
}

TEST(Doubtful, rigs_that_deform_in_one_hierarchy_are_not) {
  const std::vector<Line> lines = tree(R"(
rig, hips 0 > DEF-spine, hips > DEF-spine.002, spine > DEF-spine.003, chest > DEF-spine.006, head)");
  EXPECT_EQ(message(lines, limbs("DEF-spine.003", "DEF-spine")), "");
  // A body with nothing but a head on it has no spine that the arms could hang on.
  EXPECT_EQ(message({{"body", "", hips}, {"head", "body", head}}, limbs("body", "body")), "");
}

// A horse of these joints for trunk, front and hind legs, half way through a step in each frame.
Clip horse(const std::vector<std::string>& names) {
  Clip clip;
  std::vector<Joint>& joints = clip.skeleton.joints;
  const auto add = [&](const std::string& name, int parent, Vec3 offset) {
    Joint joint;
    joint.name = name;
    joint.parent = parent;
    joint.offset = offset;
    joint.can_rotate = true;
    joint.can_translate = parent < 0;
    joints.push_back(joint);
    return static_cast<int>(joints.size()) - 1;
  };
  const int back = add(names[0], -1, {0, 0.8f, -0.4f});
  const int breast = add(names[1], back, {0, 0.05f, 0.5f});
  const int head = add(names[2], add(names[3], breast, {0, 0.12f, 0.15f}), {0, 0.22f, 0.12f});
  joints[static_cast<size_t>(head)].ends = {{0, 0, 0.2f}};
  for (const std::string side : {"L", "R"}) {
    const float x = side == "L" ? 0.1f : -0.1f;
    for (const int pair : {0, 1}) {
      int joint = pair == 0 ? breast : back;
      const Vec3 bones[] = {{x, -0.08f, 0.02f}, {0, -0.32f, 0}, {0, -0.3f, 0}, {0, -0.08f, 0.06f}};
      for (int k = 0; k < 4; ++k) joint = add(names[4 + pair * 4 + k] + side, joint, bones[k]);
    }
  }
  for (int f = 0; f < 20; ++f) {
    clip.append(rest_clip(clip.skeleton).pose(0));
    const Pose pose = clip.pose(f);
    for (size_t j = 4; j < clip.joints(); j += 4) {
      const float swing = 0.4f * std::sin(static_cast<float>(f) + static_cast<float>(j));
      pose.rotations[j] = axis_angle({1, 0, 0}, swing);
    }
  }
  return clip;
}

TEST(Doubtful, an_animal_on_four_legs_is_rejected_whatever_its_joints_are_called) {
  const std::vector<std::string> horses[] = {
      {"Pelvis", "Spine2", "Head", "Neck1", "Shoulder_", "Elbow_", "Wrist_", "FrontPaw_", "Hip_",
       "Knee_", "Ankle_", "RearPaw_"},
      {"b_Root", "b_Spine", "b_Head", "b_Neck", "b_Arm_", "b_Forearm_", "b_Hand_", "b_Fingers_",
       "b_Thigh_", "b_Calf_", "b_Foot_", "b_Toe_"}};
  for (const std::vector<std::string>& names : horses) {
    const std::string message = rejection_of(horse(names));
    EXPECT_TRUE(message.starts_with("no person: leftUpperArm would be '")) << message;
  }
  RigOptions given;
  given.joints[index(hips)] = "b_Root";
  EXPECT_EQ(rejection_of(horse(horses[1]), given), "");
}

// On hands and knees all the time, on a skeleton that stands upright at rest.
TEST(Doubtful, a_person_who_crawls_is_none) {
  Clip clip = walking_clip(20);
  for (int f = 0; f < clip.frames; ++f) {
    const Pose pose = clip.pose(f);
    const auto turn = [&](HumanJoint joint, float angle) {
      Quat& q = pose.rotations[static_cast<size_t>(index(joint))];
      q = axis_angle({1, 0, 0}, angle) * q;
    };
    turn(hips, 1.5f);
    for (const HumanJoint limb : {left_upper_arm, right_upper_arm, left_upper_leg, right_upper_leg})
      turn(limb, -1.5f);
  }
  EXPECT_EQ(rejection_of(clip), "");
}

}  // namespace
}  // namespace panache
