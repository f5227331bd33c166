// Strengths as they are in force: the posture grows evenly up to 2, movement more slowly beyond 1.

#include "style/stages/strengths.h"

#include <vector>

#include <gtest/gtest.h>

namespace panache {
namespace {

// The shape that these strengths come to at once.
Shape in_force(const std::vector<float>& strengths, const Shape& shape = {}) {
  EasedStrengths eased(strengths.size(), 0);
  eased.step(strengths, shape, {1 / 30.0, 1 / 30.0f, true});
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

}  // namespace
}  // namespace panache
