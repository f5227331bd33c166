// Rigs that would be torn are rejected.

#include <gtest/gtest.h>

#include "rig/made_up.h"
#include "rig/rig.h"

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
  const Result<Rig> rig = Rig::create(make_up(lines, "L", "R").clip(), options);
  return rig ? "" : rig.error().message;
}

TEST(Doubtful, a_torso_of_controls_with_limbs_that_deform_is_rejected) {
  const std::vector<Line> lines = {{"root", "", hips, 0},
                                   {"torso", "root", hips},
                                   {"spine_fk.002", "torso", spine},
                                   {"ORG-spine.003", "spine_fk.002", chest},
                                   {"head", "ORG-spine.003", head}};
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
  const std::vector<Line> spine_alone = {{"rig", "", hips},
                                         {"DEF-spine", "rig", spine, 0.1f},
                                         {"DEF-spine.001", "DEF-spine", spine, 0.5f},
                                         {"DEF-spine.002", "DEF-spine.001", spine},
                                         {"DEF-spine.003", "DEF-spine.002", chest},
                                         {"DEF-spine.004", "DEF-spine.003", neck},
                                         {"DEF-spine.006", "DEF-spine.004", head}};
  EXPECT_EQ(message(spine_alone, limbs("rig", "rig")),
            "doubtful: leftUpperArm 'DEF-upper_arm.L' does not hang on the spine 'DEF-spine', but "
            "beside it on 'rig'; expected the joints that deform the mesh in one hierarchy, a map "
            "that says which these are, or the motion styled where its controls are");
}

// The same without names that tell: the skin does.
TEST(Doubtful, a_skin_that_the_hips_do_not_move_is_rejected) {
  const std::vector<Line> lines = {{"root", "", hips, 0},
                                   {"torso", "root", hips},
                                   {"spine control", "torso", spine},
                                   {"chest control", "spine control", chest},
                                   {"head control", "chest control", head},
                                   {"belly", "root", spine},
                                   {"breast", "belly", chest},
                                   {"arm.*", "chest control", left_upper_arm},
                                   {"forearm.*", "arm.*", left_lower_arm},
                                   {"hand.*", "forearm.*", left_hand},
                                   {"thigh.*", "torso", left_upper_leg},
                                   {"shin.*", "thigh.*", left_lower_leg},
                                   {"foot.*", "shin.*", left_foot}};
  const auto with_weights = [&](float torso, int skin) {
    Clip clip = make_up(lines, "L", "R").clip();
    for (Joint& joint : clip.skeleton.joints) {
      const bool on_limb = joint.name.ends_with("L") || joint.name.ends_with("R");
      const bool on_torso = joint.name == "belly" || joint.name == "breast";
      if (!on_limb && !on_torso) continue;
      joint.skin = on_torso ? skin : 0;
      joint.skin_weight = on_torso ? torso : 100;
    }
    const Result<Rig> rig = Rig::create(clip);
    return rig ? "" : rig.error().message;
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
  const std::vector<Line> lines = {{"metarig", "", hips, 0},
                                   {"spine", "metarig", hips},
                                   {"spine.003", "spine", chest},
                                   {"head", "spine.003", head},
                                   {"upper_arm.*", "spine.003", left_upper_arm},
                                   {"forearm.*", "upper_arm.*", left_lower_arm},
                                   {"hand.*", "forearm.*", left_hand},
                                   {"thigh.*", "spine", left_upper_leg},
                                   {"shin.*", "thigh.*", left_lower_leg},
                                   {"foot.*", "shin.*", left_foot},
                                   {"rig", "", hips, 0}};
  Clip clip = make_up(lines, "L", "R").clip();
  const auto rejection = [&] {
    const Result<Rig> rig = Rig::create(clip);
    return rig ? "" : rig.error().message;
  };
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
  EXPECT_EQ(rejection(), "");  // A prop.
  add("tail.10");
  EXPECT_EQ(rejection(),
            "doubtful: hips would be 'spine', which moves no mesh; the mesh follows other joints, "
            "such as 'tail.0'; expected a file without the skeleton that moves none, or a map");
}

TEST(Doubtful, rigs_that_deform_in_one_hierarchy_are_not) {
  const std::vector<Line> lines = {{"rig", "", hips, 0},
                                   {"DEF-spine", "rig", hips},
                                   {"DEF-spine.002", "DEF-spine", spine},
                                   {"DEF-spine.003", "DEF-spine.002", chest},
                                   {"DEF-spine.006", "DEF-spine.003", head}};
  EXPECT_EQ(message(lines, limbs("DEF-spine.003", "DEF-spine")), "");
  // A body with nothing but a head on it has no spine that the arms could hang on.
  EXPECT_EQ(message({{"body", "", hips}, {"head", "body", head}}, limbs("body", "body")), "");
}

}  // namespace
}  // namespace panache
