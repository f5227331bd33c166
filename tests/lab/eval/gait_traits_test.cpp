#include "eval/gait_traits.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "eval/make_swings.h"

namespace panache {
namespace {

using enum HumanJoint;

// A take of 4 s whose joints move as this function sets them.
template <class Set>
Take take_of(Set&& set) {
  Take take;
  for (int f = 0; f < 120; ++f) {
    HumanPositions body{};
    for (int j = 0; j < kHumanJoints; ++j) body[j] = {0, 0.8f, 0};
    body[index(neck)] = {0, 1.3f, 0};
    body[index(chest)] = {0, 1.1f, 0};
    for (const float side : {1.0f, -1.0f}) {
      const bool left = side > 0;
      body[index(left ? left_upper_leg : right_upper_leg)] = {0.1f * side, 0.8f, 0};
      body[index(left ? left_lower_leg : right_lower_leg)] = {0.1f * side, 0.4f, 0};
      body[index(left ? left_upper_arm : right_upper_arm)] = {0.2f * side, 1.2f, 0};
      body[index(left ? left_lower_arm : right_lower_arm)] = {0.2f * side, 0.95f, 0};
      body[index(left ? left_hand : right_hand)] = {0.2f * side, 0.7f, 0};
    }
    set(static_cast<double>(f) / kTakeRate, body);
    take.body.push_back(body);
  }
  return take;
}

float wave(double seconds, double hertz) {
  return static_cast<float>(std::sin(2 * std::numbers::pi * hertz * seconds));
}

TEST(Movement, is_that_of_the_limbs) {
  const Take take = take_of([](double t, HumanPositions& body) {
    body[index(left_foot)].z = 0.3f * wave(t, 0.9);
    body[index(right_foot)].z = -0.3f * wave(t, 0.9);
    body[index(left_hand)] = {0.2f, 1.45f, 0.1f * wave(t, 1)};
    body[index(right_hand)] = {-0.2f, 1.45f, -0.1f * wave(t, 1)};
    body[index(left_lower_leg)] = {0.1f, 0.6f, 0.3464f};  // 60 degrees forward.
    body[index(right_lower_leg)] = {-0.1f, 0.6f, 0.3464f};
    body[index(neck)] = body[0] + Vec3{0, 0.5f, 0.5f};
  });
  const Movement found = movement_of(take);
  EXPECT_NEAR(found[0], 60, 0.1);
  EXPECT_NEAR(found[1], 0.25 / (0.25 + std::hypot(0.5, 0.1)), 0.02);
  EXPECT_NEAR(found[2], 10 / std::sqrt(2.0) * 0.85 / 0.8, 0.2);  // On a leg of 0.85 m.
  EXPECT_NEAR(found[3], 0, 1e-3);
  EXPECT_NEAR(found[4], 45, 0.1);
  EXPECT_NEAR(found[kStepsTrait], 1.8, 0.05);
  EXPECT_NEAR(found[6], 1, 1e-5);
}

TEST(Movement, leaves_out_the_first_moments_and_takes_of_less_than_a_second) {
  Take take = take_of([](double t, HumanPositions& body) {
    if (t < 0.3) body[index(neck)] = body[0] + Vec3{0, 0, 5};
  });
  EXPECT_NEAR(movement_of(take)[4], 0, 1e-3);
  take.body.resize(20);
  EXPECT_TRUE(std::isnan(movement_of(take)[4]));
  EXPECT_TRUE(side_of(take).empty());
}

TEST(Side, of_the_mirror_image_is_the_opposite_and_of_a_symmetric_body_nothing) {
  const auto limp = [](double t, HumanPositions& body) {
    body[index(left_foot)].z = 0.4f * wave(t, 1);
    body[index(neck)].x = 0.1f;
  };
  const SideVector side = side_of(take_of(limp));
  const SideVector other = side_of(take_of([&](double t, HumanPositions& body) {
    limp(t, body);
    body = mirrored(body);
  }));
  ASSERT_EQ(side.size(), 2u * kHumanJoints);
  for (size_t i = 0; i < side.size(); ++i) EXPECT_NEAR(length(side[i] + other[i]), 0, 1e-6) << i;
  EXPECT_NEAR(length(side[index(neck)]), 0.1, 1e-5);
  EXPECT_NEAR(side[kHumanJoints + index(left_foot)].z, 0.4 / std::sqrt(2.0) / 2, 0.01);
  EXPECT_NEAR(side_size(side_of(take_of([](double, HumanPositions&) {}))), 0, 1e-6);
}

TEST(Side, is_of_whole_strides) {
  Take take = take_of([](double t, HumanPositions& body) {
    body[index(left_foot)].z = 0.4f * wave(t, 1);
    body[index(right_foot)].z = -0.4f * wave(t, 1);
  });
  take.body.resize(static_cast<size_t>((0.4 + 2.5) * kTakeRate));
  EXPECT_NEAR(length(side_of(take)[index(left_foot)]), 0, 0.01);
}

}  // namespace
}  // namespace panache
