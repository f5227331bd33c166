#include "learn/take.h"

#include <gtest/gtest.h>

#include "learn/make_walk_take.h"
#include "learn/samples.h"

namespace panache {
namespace {

TEST(PoseError, the_true_change_leaves_no_error) {
  const Take neutral = test::walk_take("neutral", "walk", 60, 0);
  const Take styled = test::walk_take("old", "walk", 60, test::kBend);
  const StyleDelta truth = change_between(styled, 20, neutral, 20, 1);
  const PoseError error = pose_error(styled, 20, neutral, 20, truth);
  // Rotation vectors in single precision; the trunk is resampled along its bend.
  EXPECT_LT(error.degrees, 0.05);
  EXPECT_LT(error.cm, 0.5);
}

TEST(PoseError, a_turn_of_one_joint_is_shared_among_all_joints) {
  const Take neutral = test::walk_take("neutral", "walk", 60, 0);
  StyleDelta change;
  change.rotations[index(HumanJoint::head)].x = 0.5f;
  const PoseError error = pose_error(neutral, 20, neutral, 20, change);
  EXPECT_NEAR(error.degrees, 0.5 * 180 / M_PI / kHumanJoints, 1e-3);
  EXPECT_NEAR(error.cm, 0, 1e-6);  // Nothing hangs on the head.
}

TEST(PoseError, a_body_that_is_too_low_is_off_by_that_much_everywhere) {
  const Take neutral = test::walk_take("neutral", "walk", 60, 0);
  StyleDelta change;
  change.hips_height = -0.07f;
  const PoseError error = pose_error(neutral, 20, neutral, 20, change);
  EXPECT_NEAR(error.cm, 7, 1e-4);
  EXPECT_NEAR(error.degrees, 0, 1e-3);
}

TEST(PoseError, between_frames_the_neutral_body_is_between_them) {
  const Take neutral = test::walk_take("neutral", "walk", 60, 0);
  const double before = pose_error(neutral, 20, neutral, 20, {}).cm;
  const double half = pose_error(neutral, 20, neutral, 20.5f, {}).cm;
  const double whole = pose_error(neutral, 20, neutral, 21, {}).cm;
  EXPECT_EQ(before, 0);
  EXPECT_NEAR(half, whole / 2, 0.02 * whole);
}

}  // namespace
}  // namespace panache
