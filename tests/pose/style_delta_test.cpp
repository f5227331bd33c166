#include "pose/style_delta.h"

#include <cmath>

#include <gtest/gtest.h>

#include "base/quat.h"

namespace panache {
namespace {

std::array<float, StyleDelta::kSize> counting() {
  std::array<float, StyleDelta::kSize> numbers;
  for (size_t n = 0; n < numbers.size(); ++n) numbers[n] = static_cast<float>(n) + 0.5f;
  return numbers;
}

TEST(StyleDelta, packing_and_unpacking_are_the_reverse_of_each_other) {
  const std::array<float, StyleDelta::kSize> numbers = counting();
  std::array<float, StyleDelta::kSize> back{};
  pack(unpack(numbers), back);
  EXPECT_EQ(back, numbers);
}

// Model files hold numbers in this order: it may never change.
TEST(StyleDelta, the_numbers_stand_in_the_order_of_the_model_file) {
  static_assert(StyleDelta::kSize == 67);
  const StyleDelta delta = unpack(counting());
  for (int j = 0; j < kHumanJoints; ++j) {
    const float first = 3.0f * static_cast<float>(j) + 0.5f;
    EXPECT_EQ(delta.rotations[j].x, first);
    EXPECT_EQ(delta.rotations[j].y, first + 1);
    EXPECT_EQ(delta.rotations[j].z, first + 2);
  }
  EXPECT_EQ(delta.hips_height, 63.5f);
  EXPECT_EQ(delta.velocity_left, 64.5f);
  EXPECT_EQ(delta.velocity_forward, 65.5f);
  EXPECT_EQ(delta.turn_rate, 66.5f);
}

TEST(StyleDelta, mirrored_it_changes_the_mirrored_body) {
  const auto mirror = [](Vec3 v) { return Vec3{-v.x, v.y, v.z}; };
  std::array<float, StyleDelta::kSize> numbers;
  for (size_t n = 0; n < numbers.size(); ++n) numbers[n] = std::sin(static_cast<float>(n));
  const StyleDelta delta = unpack(numbers), other = mirrored(delta);
  const Vec3 limb = {0.3f, -0.2f, 0.5f};
  for (int j = 0; j < kHumanJoints; ++j) {
    const Vec3 turned = rotate(exp_rotation(delta.rotations[j]), limb);
    const Vec3 seen = rotate(exp_rotation(other.rotations[kHumanMirror[j]]), mirror(limb));
    EXPECT_LT(length(seen - mirror(turned)), 1e-6f) << "joint " << j;  // Single precision.
  }
  EXPECT_EQ(other.hips_height, delta.hips_height);
  EXPECT_EQ(other.velocity_left, -delta.velocity_left);
  EXPECT_EQ(other.velocity_forward, delta.velocity_forward);
  EXPECT_EQ(other.turn_rate, -delta.turn_rate);
}

TEST(StyleDelta, without_a_word_it_changes_nothing) {
  std::array<float, StyleDelta::kSize> numbers = counting();
  pack({}, numbers);
  for (const float number : numbers) EXPECT_EQ(number, 0);
}

}  // namespace
}  // namespace panache
