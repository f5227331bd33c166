// Clips: their poses in the world, between frames, and in other axes.

#include <limits>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "base/random.h"
#include "clip/clip.h"

namespace panache {
namespace {

Clip two_frames() {
  Clip clip;
  clip.skeleton.joints.resize(2);
  clip.skeleton.joints[1].parent = 0;
  clip.resize(2);
  clip.rotations = {{0, 0, 0, 1},
                    axis_angle(Vec3{0.6f, 0.48f, 0.64f}, 0.7f),
                    rotation_y(1.0f),
                    axis_angle(Vec3{0.6f, 0.48f, 0.64f}, 0.7f)};
  clip.translations = {{0, 0, 0}, {0.1f, 15.7357f, -0.3f}, {2, 4, 6}, {0.1f, 15.7357f, -0.3f}};
  return clip;
}

struct PoseArrays {
  std::vector<Quat> rotations = std::vector<Quat>(2);
  std::vector<Vec3> translations = std::vector<Vec3>(2);
  operator Pose() { return {rotations, translations}; }
};

TEST(Clip, whole_frames_come_back_bit_for_bit) {
  const Clip clip = two_frames();
  PoseArrays out;
  for (int frame = 0; frame < 2; ++frame) {
    sample(clip, frame, out);
    for (size_t j = 0; j < 2; ++j) {
      EXPECT_EQ(out.rotations[j], clip.pose(frame).rotations[j]);
      EXPECT_EQ(out.translations[j], clip.pose(frame).translations[j]);
    }
  }
}

TEST(Clip, halfway_is_halfway) {
  PoseArrays out;
  sample(two_frames(), 0.5, out);
  const Quat half = rotation_y(0.5f);
  EXPECT_NEAR(out.rotations[0].y, half.y, 1e-6);
  EXPECT_NEAR(out.rotations[0].w, half.w, 1e-6);
  EXPECT_EQ(out.translations[0], (Vec3{1, 2, 3}));
}

TEST(Clip, a_still_joint_does_not_tremble) {
  const Clip clip = two_frames();
  PoseArrays out;
  for (double t = 0; t < 1; t += 0.01) {
    sample(clip, t, out);
    EXPECT_EQ(out.rotations[1], clip.rotations[1]) << t;
    EXPECT_EQ(out.translations[1], clip.translations[1]) << t;
  }
}

TEST(Clip, rotations_take_the_shorter_arc) {
  Clip clip = two_frames();
  const Quat q = clip.rotations[2];
  clip.rotations[2] = {-q.x, -q.y, -q.z, -q.w};
  PoseArrays out;
  sample(clip, 0.5, out);
  EXPECT_NEAR(out.rotations[0].w, rotation_y(0.5f).w, 1e-6);
}

TEST(Clip, times_outside_are_clamped) {
  const Clip clip = two_frames();
  PoseArrays out;
  for (const double early : {-1.0, -1e300, std::numeric_limits<double>::quiet_NaN()}) {
    sample(clip, early, out);
    EXPECT_EQ(out.translations[0], clip.translations[0]);
  }
  for (const double late : {1.5, 1e300}) {
    sample(clip, late, out);
    EXPECT_EQ(out.translations[0], clip.translations[2]);
  }
}

TEST(Clip, duration_counts_every_frame) {
  Clip clip = two_frames();
  clip.frame_time = 0.25;
  EXPECT_EQ(clip.duration(), 0.5);
}

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
  PoseArrays world = {rotations, translations};
  world_pose(skeleton, {rotations, translations}, world);
  // z turns x to y, so the second joint is above the first; then x turns the third's z to -y, which
  // z turns to +x. Each coordinate is off by a few roundings of numbers of about ten.
  const Vec3 expected[] = {{10, 0, 0}, {10, 1, 0}, {12, 1, 0}};
  for (size_t j = 0; j < 3; ++j) {
    EXPECT_LT(length(world.translations[j] - expected[j]), 4e-6f) << j;
  }
  EXPECT_NEAR(dot(world.rotations[2], rotations[0] * rotations[1]), 1, 1e-6f);
}

TEST(WorldPose, each_root_stands_in_the_world) {
  Skeleton skeleton = chain(2);
  skeleton.joints[1].parent = -1;
  const PoseArrays local = {{rotation_y(1.0f), rotation_y(2.0f)}, {{1, 2, 3}, {4, 5, 6}}};
  PoseArrays world;
  world_pose(skeleton, {local.rotations, local.translations}, world);
  EXPECT_EQ(world.rotations, local.rotations);
  EXPECT_EQ(world.translations, local.translations);
}

TEST(WorldPose, may_work_in_place_and_a_deep_chain_stays_unit) {
  PoseArrays pose = {std::vector(1000, axis_angle(Vec3{0, 0.6f, 0.8f}, 0.3f)),
                     std::vector(1000, Vec3{1, 2, 3})},
             world = pose;
  world_pose(chain(1000), {pose.rotations, pose.translations}, world);
  world_pose(chain(1000), {pose.rotations, pose.translations}, pose);
  EXPECT_EQ(pose.rotations, world.rotations);
  EXPECT_EQ(pose.translations, world.translations);
  EXPECT_NEAR(dot(pose.rotations.back(), pose.rotations.back()), 1, 1e-6f);
}

Quat some_rotation(Random& random) {
  const auto number = [&] { return static_cast<float>(random.normal()); };
  return normalized(Quat{number(), number(), number(), number()});
}

// A chain with a branch, every joint turned at rest, in three frames.
Clip turned_clip(bool turned) {
  Random random(1);
  Clip clip;
  for (int j = 0; j < 5; ++j) {
    Joint joint;
    joint.name = "joint" + std::to_string(j);
    joint.parent = j == 4 ? 1 : j - 1;
    joint.offset = {0.1f * static_cast<float>(j), 0.5f, -0.2f};
    if (turned) joint.rest = some_rotation(random);
    joint.ends = {{0, 0.3f, 0.1f}};
    clip.skeleton.joints.push_back(joint);
  }
  clip.resize(3);
  for (Quat& q : clip.rotations) q = some_rotation(random);
  for (size_t i = 0; i < clip.translations.size(); ++i) {
    clip.translations[i] = {0.2f, 0.4f, 0.1f * static_cast<float>(i)};
  }
  return clip;
}

// Five joints of half a metre, a few roundings of 2^-24 each.
constexpr float kNear = 2e-6f;

void expect_same_positions(const Clip& a, const Clip& b) {
  std::vector<Quat> turns_a(a.joints()), turns_b(b.joints());
  std::vector<Vec3> positions_a(a.joints()), positions_b(b.joints());
  for (int f = 0; f < a.frames; ++f) {
    world_pose(a.skeleton, a.pose(f), {turns_a, positions_a});
    world_pose(b.skeleton, b.pose(f), {turns_b, positions_b});
    for (size_t j = 0; j < a.joints(); ++j) {
      EXPECT_LE(length(positions_a[j] - positions_b[j]), kNear) << j;
      const Vec3 end_a = positions_a[j] + rotate(turns_a[j], a.skeleton.joints[j].ends[0]);
      const Vec3 end_b = positions_b[j] + rotate(turns_b[j], b.skeleton.joints[j].ends[0]);
      EXPECT_LE(length(end_a - end_b), kNear) << "end of " << j;
    }
  }
}

TEST(RestAxes, a_motion_keeps_every_place_and_rests_without_rotation) {
  const Clip clip = turned_clip(true), out = in_rest_axes(clip);
  for (const Joint& joint : out.skeleton.joints) EXPECT_EQ(joint.rest, Quat{});
  expect_same_positions(clip, out);
  expect_same_positions(rest_clip(clip.skeleton), rest_clip(out.skeleton));
}

TEST(RestAxes, a_motion_that_rests_without_rotation_stays_as_it_is) {
  const Clip clip = turned_clip(false), out = in_rest_axes(clip);
  EXPECT_EQ(clip.rotations, out.rotations);
  EXPECT_EQ(clip.translations, out.translations);
}

}  // namespace
}  // namespace panache
