#include "pose/features.h"

#include <gtest/gtest.h>

#include "base/random.h"

namespace panache {
namespace {

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
