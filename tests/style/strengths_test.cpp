// Strengths as they are in force: the posture grows evenly up to 2, movement more slowly beyond 1.

#include "style/stages/strengths.h"

#include <vector>

#include <gtest/gtest.h>

namespace panache {
namespace {

// The shape that these strengths come to at once.
Shape in_force(const std::vector<float>& strengths, const Shape& shape = {}) {
  EasedStrengths eased(strengths.size(), 0);
  const std::vector<float> sides(strengths.size(), 1);
  eased.step(strengths, sides, shape, {1 / 30.0, 1 / 30.0f, true});
  return eased.shape();
}

TEST(Strengths, up_to_1_leave_the_shape_as_it_is) {
  EXPECT_EQ(in_force({1, -0.5f, 0}), Shape{});
  EXPECT_EQ(in_force({0, 0}), Shape{});
}

TEST(Strengths, of_2_move_as_1_3_and_hold_as_2) {
  EXPECT_FLOAT_EQ(in_force({2}).dynamics, 1.3f / 2);
  EXPECT_FLOAT_EQ(in_force({-2}).dynamics, 1.3f / 2);
  EXPECT_EQ(in_force({2}).posture, 1);
}

TEST(Strengths, of_several_styles_share_the_dynamics) {
  EXPECT_FLOAT_EQ(in_force({2, 1}).dynamics, 2.3f / 3);
  EXPECT_FLOAT_EQ(in_force({4}).dynamics, 1.9f / 2.6f);
  Shape shape;
  shape.dynamics = 0.5f;
  EXPECT_FLOAT_EQ(in_force({2}, shape).dynamics, 0.5f * 1.3f / 2);
}

TEST(Sides, of_an_active_style_ease_and_of_one_that_is_off_change_at_once) {
  EasedStrengths eased(2, 0.15f);
  const StepTime first{1 / 30.0, 1 / 30.0f, true}, next{1 / 30.0, 1 / 30.0f, false};
  const std::vector<float> strengths = {1, 0}, captured = {1, 1}, mirrored = {-1, -1};
  eased.step(strengths, captured, {}, first);
  eased.step(strengths, mirrored, {}, next);
  EXPECT_LT(eased.sides()[0], 1);
  EXPECT_GT(eased.sides()[0], 0.3f);
  EXPECT_EQ(eased.sides()[1], -1);
  for (int step = 0; step < 60; ++step) eased.step(strengths, mirrored, {}, next);
  EXPECT_EQ(eased.sides()[0], -1);
  // The second style comes on with the side that it gets in the same step.
  eased.step(std::vector<float>{1, 1}, captured, {}, next);
  EXPECT_EQ(eased.sides()[1], 1);
}

}  // namespace
}  // namespace panache
