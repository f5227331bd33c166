#include "rig/canonical_body.h"

#include <gtest/gtest.h>

#include "rig/made_up.h"

namespace panache {
namespace {

using namespace test;
using enum HumanJoint;

TEST(CanonicalSkeleton, stands_in_t_pose_on_the_ground) {
  const Skeleton body = canonical_skeleton();
  const HumanPositions p = t_pose();
  ASSERT_EQ(body.joints.size(), size_t{kHumanJoints});
  for (int j = 0; j < kHumanJoints; ++j) {
    EXPECT_EQ(body.joints[j].parent, kHumanParent[j]);
    EXPECT_EQ(body.joints[j].name, human_joint_name(j));
    EXPECT_TRUE(body.joints[j].can_rotate);
    EXPECT_EQ(body.joints[j].can_translate, j == 0);
    const Vec3 other = p[kHumanMirror[j]];
    EXPECT_NEAR(p[j].x, -other.x, 1e-6f);
    EXPECT_NEAR(p[j].y, other.y, 1e-6f);
  }
  EXPECT_NEAR(p[index(left_toes)].y, 0, 1e-6f);
  EXPECT_GT(p[index(left_toes)].z, 0.08f);
  EXPECT_GT(p[index(left_hand)].x, 0.5f);
  EXPECT_NEAR(p[index(left_hand)].y, p[index(left_upper_arm)].y, 1e-6f);
  for (HumanJoint end : {head, left_hand, right_hand, left_toes, right_toes}) {
    EXPECT_EQ(body.joints[index(end)].ends.size(), 1u);
  }
}

TEST(CanonicalSkeleton, frames_of_the_t_pose_are_the_identity) {
  std::array<Quat, kHumanJoints> world;
  canonical_frames(t_pose(), 0, world);
  for (const Quat& q : world) {
    EXPECT_LT(length(q.xyz()), 1e-6f);
    EXPECT_GT(q.w, 0);
  }
}

// Positions of the skeleton in the world rotations given.
HumanPositions positions_of(const std::array<Quat, kHumanJoints>& world, Vec3 root) {
  const Skeleton body = canonical_skeleton();
  HumanPositions out;
  out[0] = root;
  for (int j = 1; j < kHumanJoints; ++j) {
    out[j] = out[kHumanParent[j]] + rotate(world[kHumanParent[j]], body.joints[j].offset);
  }
  return out;
}

TEST(CanonicalSkeleton, frames_reproduce_the_positions_of_the_skeleton_in_any_pose) {
  for (const bool shrugs : {true, false}) {
    Clip clip = random_clip(canonical_skeleton(), 200, 1.2f, shrugs ? 1 : 2);
    for (int f = 0; f < clip.frames; ++f) {
      for (HumanJoint joint : {left_shoulder, right_shoulder}) {
        if (!shrugs) clip.pose(f).rotations[index(joint)] = {};
      }
      std::array<Quat, kHumanJoints> world;
      HumanPositions want;
      world_pose(clip.skeleton, clip.pose(f), {world, want});
      canonical_frames(want, shrugs ? 0.3f : -2, world);
      const HumanPositions got = positions_of(world, want[0]);
      // Shoulders that shrug by turning move mid-shoulder off the chest's axis: only what does not
      // hang on the chest comes back where it was, and arms come back in direction.
      for (int j = 1; j < kHumanJoints; ++j) {
        const int p = kHumanParent[j];
        if (!shrugs || j <= index(chest) || j >= index(left_upper_leg)) {
          EXPECT_LT(length(got[j] - want[j]), 1e-5f) << human_joint_name(j);
        } else if (p != index(chest)) {
          EXPECT_LT(angle_deg(got[j] - got[p], want[j] - want[p]), 0.01) << human_joint_name(j);
        }
      }
    }
  }
}

TEST(CanonicalSkeleton, frames_of_a_turning_body_do_not_flip_their_signs) {
  std::array<Quat, kHumanJoints> before, now;
  for (int i = 0; i <= 720; ++i) {
    const float facing = static_cast<float>(i) * 3.14159265f / 180;
    HumanPositions body = t_pose();
    for (Vec3& p : body) p = rotate(rotation_y(facing), p);
    canonical_frames(body, facing, now);
    for (int j = 0; i && j < kHumanJoints; ++j) EXPECT_GT(dot(before[j], now[j]), 0.99f);
    before = now;
  }
}

TEST(CanonicalSkeleton, degenerate_positions_give_finite_frames) {
  std::array<Quat, kHumanJoints> world;
  canonical_frames(HumanPositions{}, 1, world);
  for (const Quat& q : world) EXPECT_TRUE(is_finite(q));
  HumanPositions body = t_pose();
  body[index(left_upper_leg)] = body[index(right_upper_leg)];
  body[index(left_hand)] = body[index(left_lower_arm)];
  canonical_frames(body, 0, world);
  for (const Quat& q : world) EXPECT_NEAR(dot(q, q), 1, 1e-5f);
}

}  // namespace
}  // namespace panache
