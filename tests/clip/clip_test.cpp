#include "clip/clip.h"

#include <limits>

#include <gtest/gtest.h>

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

}  // namespace
}  // namespace panache
