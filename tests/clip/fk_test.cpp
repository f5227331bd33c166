#include "clip/clip.h"

#include <numbers>
#include <vector>

#include <gtest/gtest.h>

namespace panache {
namespace {

constexpr float kRightAngle = std::numbers::pi_v<float> / 2;

Skeleton chain(size_t joints) {
  Skeleton skeleton;
  skeleton.joints.resize(joints);
  for (size_t j = 1; j < joints; ++j) skeleton.joints[j].parent = static_cast<int>(j) - 1;
  return skeleton;
}

TEST(WorldPose, rotations_and_translations_add_up_from_the_root) {
  const Skeleton skeleton = chain(3);
  const std::vector<Quat> rotations = {axis_angle(Vec3{0, 0, 1}, kRightAngle),
                                       axis_angle(Vec3{1, 0, 0}, kRightAngle), Quat{}};
  const std::vector<Vec3> translations = {{10, 0, 0}, {1, 0, 0}, {0, 0, 2}};
  std::vector<Quat> world_rotations(3);
  std::vector<Vec3> world_translations(3);
  world_pose(skeleton, {rotations, translations}, {world_rotations, world_translations});
  // z turns x to y, so the second joint is above the first; then x turns the third's z to -y, which
  // z turns to +x. Each coordinate is off by a few roundings of numbers of about ten.
  const Vec3 expected[] = {{10, 0, 0}, {10, 1, 0}, {12, 1, 0}};
  for (size_t j = 0; j < 3; ++j) {
    EXPECT_NEAR(world_translations[j].x, expected[j].x, 4e-6f) << j;
    EXPECT_NEAR(world_translations[j].y, expected[j].y, 4e-6f) << j;
    EXPECT_NEAR(world_translations[j].z, expected[j].z, 4e-6f) << j;
  }
  const Quat product = rotations[0] * rotations[1];
  EXPECT_NEAR(dot(world_rotations[2], product), 1, 1e-6f);
}

TEST(WorldPose, each_root_stands_in_the_world) {
  Skeleton skeleton = chain(2);
  skeleton.joints[1].parent = -1;
  const std::vector<Quat> rotations = {rotation_y(1.0f), rotation_y(2.0f)};
  const std::vector<Vec3> translations = {{1, 2, 3}, {4, 5, 6}};
  std::vector<Quat> world_rotations(2);
  std::vector<Vec3> world_translations(2);
  world_pose(skeleton, {rotations, translations}, {world_rotations, world_translations});
  EXPECT_EQ(world_rotations, rotations);
  EXPECT_EQ(world_translations, translations);
}

TEST(WorldPose, may_work_in_place) {
  const Skeleton skeleton = chain(4);
  std::vector<Quat> rotations(4, axis_angle(Vec3{0, 0.6f, 0.8f}, 0.3f));
  std::vector<Vec3> translations(4, Vec3{1, 2, 3});
  std::vector<Quat> world_rotations(4);
  std::vector<Vec3> world_translations(4);
  world_pose(skeleton, {rotations, translations}, {world_rotations, world_translations});
  world_pose(skeleton, {rotations, translations}, {rotations, translations});
  EXPECT_EQ(rotations, world_rotations);
  EXPECT_EQ(translations, world_translations);
}

TEST(WorldPose, a_deep_chain_stays_unit) {
  const Skeleton skeleton = chain(1000);
  std::vector<Quat> rotations(1000, axis_angle(Vec3{0, 0.6f, 0.8f}, 0.3f));
  std::vector<Vec3> translations(1000, Vec3{1, 0, 0});
  world_pose(skeleton, {rotations, translations}, {rotations, translations});
  EXPECT_NEAR(dot(rotations.back(), rotations.back()), 1, 1e-6f);
}

}  // namespace
}  // namespace panache
