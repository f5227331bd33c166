#include "rig/humanoid.h"

#include <gtest/gtest.h>

#include "rig/made_up.h"

namespace panache {
namespace {

TEST(Humanoid, every_name_is_found_again) {
  for (int j = 0; j < kHumanJoints; ++j) EXPECT_EQ(find_human_joint(human_joint_name(j)), j);
  EXPECT_EQ(human_joint_name(index(HumanJoint::left_lower_arm)), "leftLowerArm");
  EXPECT_EQ(human_joint_name(index(HumanJoint::right_toes)), "rightToes");
  EXPECT_FALSE(find_human_joint("LeftHand"));
  EXPECT_FALSE(find_human_joint(""));
  EXPECT_TRUE(human_joint_name(-1).empty());
  EXPECT_TRUE(human_joint_name(kHumanJoints).empty());
}

TEST(Humanoid, the_mirror_of_a_left_name_is_the_right_one) {
  for (int j = 0; j < kHumanJoints; ++j) {
    std::string name(human_joint_name(j));
    if (name.starts_with("left"))
      name.replace(0, 4, "right");
    else if (name.starts_with("right"))
      name.replace(0, 5, "left");
    EXPECT_EQ(human_joint_name(kHumanMirror[j]), name);
  }
}

TEST(Humanoid, proportions_are_those_of_a_person_and_the_same_on_both_sides) {
  const Proportions& body = kProportions;
  for (int j = 1; j < kHumanJoints; ++j) {
    EXPECT_EQ(body.length[j], body.length[kHumanMirror[j]]);
    EXPECT_GT(body.length[j], 0.04f);
    EXPECT_LT(body.length[j], 0.45f);
  }
  EXPECT_NEAR(body.leg, body.length[14] + body.length[15], 1e-6f);
  const Vec3 l = body.mid_shoulder_to_left_shoulder, r = body.mid_shoulder_to_right_shoulder;
  EXPECT_EQ(l, (Vec3{-r.x, r.y, r.z}));
  const HumanPositions rest = test::t_pose();
  EXPECT_NEAR(rest[index(HumanJoint::head)].y, 1.40f, 0.03f);
}

TEST(Humanoid, a_body_mirrored_twice_is_itself) {
  HumanPositions body = test::t_pose();
  body[index(HumanJoint::left_hand)] = {0.3f, 1.9f, 0.2f};
  const HumanPositions other = mirrored(body);
  EXPECT_EQ(other[index(HumanJoint::right_hand)], (Vec3{-0.3f, 1.9f, 0.2f}));
  EXPECT_EQ(other[index(HumanJoint::left_hand)], test::t_pose()[index(HumanJoint::left_hand)]);
  EXPECT_EQ(mirrored(other), body);
}

}  // namespace
}  // namespace panache
