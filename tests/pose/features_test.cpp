#include "pose/features.h"

#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/quat.h"
#include "rig/canonical_body.h"

namespace panache {
namespace {

HumanPositions t_pose() {
  HumanPositions body;
  const Skeleton skeleton = canonical_skeleton();
  for (int j = 0; j < kHumanJoints; ++j) {
    body[j] = skeleton.joints[j].offset;
    if (kHumanParent[j] >= 0) body[j] += body[kHumanParent[j]];
  }
  return body;
}

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

}  // namespace
}  // namespace panache
