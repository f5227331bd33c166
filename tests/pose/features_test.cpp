// Numbers of poses: what networks read and write.

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/quat.h"
#include "base/random.h"
#include "pose/features.h"
#include "pose/style_delta.h"
#include "rig/made_up.h"

namespace panache {
namespace {

using test::t_pose;

TEST(Features, the_body_frame_undoes_place_and_heading) {
  const HumanPositions body = t_pose();
  const RootPose root{{3, 0, -2}, 2.1f};
  HumanPositions world, back;
  for (int j = 0; j < kHumanJoints; ++j) {
    world[j] = rotate(rotation_y(root.facing), body[j]) + root.position;
  }
  to_body_frame(world, root, back);
  for (int j = 0; j < kHumanJoints; ++j) EXPECT_LT(length(back[j] - body[j]), 1e-5f);
}

TEST(Features, a_t_pose_has_no_local_rotation) {
  std::vector<float> numbers(127);
  write_pose_features(PoseLayout::rotations, t_pose(), numbers);
  const float identity[6] = {1, 0, 0, 0, 1, 0};
  for (int i = 0; i < 126; ++i) EXPECT_NEAR(numbers[i], identity[i % 6], 1e-4) << i;
  EXPECT_NEAR(numbers[126], t_pose()[0].y, 1e-6);
}

TEST(Features, walking_ahead_is_forward_velocity_whatever_the_heading) {
  for (const float facing : {0.0f, 1.0f, -2.5f}) {
    const Vec3 ahead = rotate(rotation_y(facing), Vec3{0, 0, 0.06f});
    std::array<float, kRootFeatures> root;
    write_root_features({{1, 0, 1}, facing}, {Vec3{1, 0, 1} + ahead, facing}, 0.05, root);
    EXPECT_NEAR(root[0], 0, 1e-4);
    EXPECT_NEAR(root[1], 1.2, 1e-4);
    EXPECT_EQ(root[2], 0);
  }
}

TEST(Features, an_angle_unwraps_to_the_nearest_turn) {
  constexpr float turn = 2 * std::numbers::pi_v<float>;
  EXPECT_NEAR(unwrap_angle(-3.1f, 3.1f), turn - 3.1f, 1e-5);
  EXPECT_NEAR(unwrap_angle(0.1f, 5 * turn), 5 * turn + 0.1f, 1e-4);
  EXPECT_EQ(unwrap_angle(1.0f, 0.5f), 1.0f);
}

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

AbsolutePose random_pose() {
  Random random(4);
  AbsolutePose pose;
  for (Quat& q : pose.rotations) {
    q = exp_rotation(Vec3{random.normal(), random.normal(), random.normal()});
  }
  pose.hips_height = 0.9f;
  pose.root = {0.1f, 1.2f, -0.3f};
  return pose;
}

TEST(AbsolutePose, packing_and_unpacking_are_the_reverse_of_each_other) {
  const AbsolutePose pose = random_pose();
  std::array<float, AbsolutePose::kSize> numbers;
  pack(pose, numbers);
  const AbsolutePose back = unpack_pose(numbers);
  for (int j = 0; j < kHumanJoints; ++j) {
    EXPECT_NEAR(std::abs(dot(back.rotations[j], pose.rotations[j])), 1, 1e-6);  // Single precision.
  }
  EXPECT_EQ(back.hips_height, pose.hips_height);
  EXPECT_EQ(back.root, pose.root);
}

// Model files hold numbers in this order: it may never change.
TEST(AbsolutePose, the_numbers_stand_in_the_order_of_the_model_file) {
  AbsolutePose pose = random_pose();
  pose.rotations[1] = {};  // Its columns are x and y themselves.
  std::array<float, AbsolutePose::kSize> numbers;
  pack(pose, numbers);
  EXPECT_EQ(AbsolutePose::kSize, 130);
  EXPECT_EQ((std::vector<float>(&numbers[6], &numbers[12])),
            (std::vector<float>{1, 0, 0, 0, 1, 0}));
  EXPECT_EQ(numbers[126], 0.9f);
  EXPECT_EQ((std::vector<float>(&numbers[127], &numbers[129] + 1)),
            (std::vector<float>{0.1f, 1.2f, -0.3f}));
}

TEST(AbsolutePose, columns_that_are_hardly_any_still_give_a_rotation) {
  std::array<float, AbsolutePose::kSize> numbers;
  for (const float all : {0.0f, 1.0f, -1e-20f}) {
    numbers.fill(all);
    for (const Quat& q : unpack_pose(numbers).rotations) EXPECT_NEAR(dot(q, q), 1, 1e-5) << all;
  }
}

}  // namespace
}  // namespace panache
