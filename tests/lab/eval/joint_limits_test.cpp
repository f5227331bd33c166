#include "eval/joint_limits.h"

#include <cstdlib>
#include <filesystem>
#include <vector>

#include <gtest/gtest.h>

#include "learn/take.h"
#include "posed_body.h"
#include "takes/load_takes.h"
#include "takes/manifest.h"

namespace panache {
namespace {

using enum HumanJoint;

using namespace test;

void expect_inside(const std::vector<Turn>& turns) {
  const BeyondLimit found = beyond_limits(posed(turns));
  EXPECT_EQ(found.degrees, 0) << human_joint_name(index(found.joint));
}
void expect_beyond(const std::vector<Turn>& turns, HumanJoint joint, float degrees) {
  const BeyondLimit found = beyond_limits(posed(turns));
  EXPECT_EQ(found.joint, joint) << human_joint_name(index(found.joint));
  // Trunk and neck are resampled from positions: they lean by some degrees at rest.
  EXPECT_NEAR(found.degrees, degrees, 6);
}

TEST(JointLimits, standing_sitting_and_reaching_up_are_human) {
  expect_inside({});
  expect_inside({{left_upper_leg, kX, -90},
                 {right_upper_leg, kX, -90},
                 {left_lower_leg, kX, 90},
                 {right_lower_leg, kX, 90}});
  expect_inside({{left_upper_arm, kX, -175}, {right_upper_arm, kZ, -170}});
  // Overhead and a little behind, inward or outward.
  expect_inside({{left_upper_arm, kX, -200}});
  expect_inside({{left_upper_arm, kZ, 200}});
}

TEST(JointLimits, arms_may_cross_in_front_and_reach_the_back) {
  expect_inside({{left_upper_arm, kX, -80}, {left_upper_arm, kY, -40}});
  expect_inside({{left_upper_arm, kX, 40}, {left_lower_arm, kElbowAxis, 90}});
}

TEST(JointLimits, knees_bend_backwards_only) {
  expect_inside({{left_lower_leg, kX, 140}});
  expect_beyond({{left_lower_leg, kX, -60}}, left_lower_leg, 60 - 2 - 20);
  expect_beyond({{right_lower_leg, kX, -60}}, right_lower_leg, 60 - 2 - 20);
  expect_beyond({{right_lower_leg, kX, 170}}, right_lower_leg, 170 - 140 - 20);
}

TEST(JointLimits, knees_of_a_raised_leg_bend_downwards) {
  expect_inside({{left_upper_leg, kX, -100}, {left_lower_leg, kX, 100}});
  expect_beyond({{left_upper_leg, kX, -100}, {left_lower_leg, kX, -70}}, left_lower_leg,
                70 - 2 - 20);
}

TEST(JointLimits, elbows_bend_forwards_only) {
  expect_inside({{left_lower_arm, kElbowAxis, 120}});
  expect_beyond({{left_lower_arm, kElbowAxis, -70}}, left_lower_arm, 70 - 10 - 20);
  expect_beyond({{right_lower_arm, kElbowAxis, 70}}, right_lower_arm, 70 - 10 - 20);
}

TEST(JointLimits, a_forearm_that_goes_through_the_upper_arm_is_beyond_by_the_shorter_way) {
  expect_beyond({{left_lower_arm, kElbowAxis, 178}}, left_lower_arm, 178 - 150 - 20);
  expect_beyond({{left_lower_arm, kElbowAxis, 200}}, left_lower_arm, 200 - 150 - 20);
}

TEST(JointLimits, swings_have_limits_of_their_own_in_each_direction) {
  expect_inside({{left_upper_leg, kX, -135}});
  expect_beyond({{left_upper_leg, kX, 70}}, left_upper_leg, 70 - 30 - 20);
  expect_beyond({{left_upper_leg, kZ, 85}}, left_upper_leg, 85 - 45 - 20);
  expect_beyond({{left_upper_leg, kZ, -70}}, left_upper_leg, 70 - 30 - 20);
  expect_beyond({{right_upper_leg, kZ, 70}}, right_upper_leg, 70 - 30 - 20);
  expect_beyond({{right_upper_arm, kX, 110}}, right_upper_arm, 110 - 60 - 20);
  expect_beyond({{head, kX, 0}, {neck, kX, 90}}, head, 90 - 45 - 20);
  expect_beyond({{neck, kX, -95}}, head, 95 - 45 - 20);
  expect_beyond({{spine, kX, -40}, {chest, kX, -40}}, spine, 80 - 30 - 20);
  expect_inside({{spine, kX, 45}, {chest, kX, 45}});
}

TEST(JointLimits, place_and_heading_and_side_do_not_matter) {
  const HumanPositions body = posed({{left_lower_leg, kX, -60}, {right_upper_arm, kZ, 20}});
  const BeyondLimit here = beyond_limits(body);
  HumanPositions there = body;
  for (Vec3& joint : there) joint = rotate(axis_angle(kY, 2.0f), joint) + Vec3{3, 0, -7};
  EXPECT_EQ(beyond_limits(there).joint, left_lower_leg);
  EXPECT_NEAR(beyond_limits(there).degrees, here.degrees, 0.01);
  const BeyondLimit other = beyond_limits(mirrored(body));
  EXPECT_EQ(other.joint, right_lower_leg);
  EXPECT_NEAR(other.degrees, here.degrees, 0.01);
}

TEST(JointLimits, a_body_without_extent_is_not_beyond_and_nothing_crashes) {
  EXPECT_EQ(beyond_limits(HumanPositions{}).degrees, 0);
}

TEST(JointLimits, real_people_keep_them) {
  const char* data = std::getenv("PANACHE_DATA");
  if (!data) GTEST_SKIP() << "PANACHE_DATA names no folder with real motion.";
  const std::filesystem::path path = std::filesystem::path(data) / "bandai-1.csv";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << "bandai-1 is not in PANACHE_DATA";
  const auto takes = load_takes(*read_manifest(path.string(), 0), PoseLayout::positions);
  ASSERT_TRUE(takes.ok()) << takes.error().message;
  int frames = 0, beyond = 0;
  for (const Take& take : *takes) {
    for (const HumanPositions& body : take.body) {
      ++frames;
      beyond += beyond_limits(body).degrees > 5;
    }
  }
  EXPECT_GT(frames, 10000);
  // Fifteen styles of walks, dashes, kicks and bows: 13 frames in 10,000, all in extreme poses.
  EXPECT_LT(beyond, frames / 400);
}

}  // namespace
}  // namespace panache
