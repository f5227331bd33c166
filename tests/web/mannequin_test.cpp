#include "mannequin.h"

#include <cmath>

#include <gtest/gtest.h>

#include "clip/bvh.h"
#include "clip/fk.h"
#include "format_clip.h"
#include "make_clip.h"
#include "recording.h"

namespace panache::web {
namespace {

TEST(MannequinTest, stands_where_the_rig_stands_and_shows_twist) {
  Clip clip = test::walking_clip(2);
  const auto hand = static_cast<size_t>(index(HumanJoint::left_hand));
  const auto arm = static_cast<size_t>(index(HumanJoint::left_lower_arm));
  clip.pose(1).rotations[hand] = axis_angle(Vec3{1, 0, 0}, 1.0f);
  // Local axes that are not those of the part.
  const Quat axes = axis_angle(Vec3{0, 0, 1}, 1.2f);
  Vec3& offset_in_file = clip.skeleton.joints[hand].offset;
  offset_in_file = rotate(conjugate(axes), offset_in_file);
  for (int f = 0; f < clip.frames; ++f) {
    const Pose pose = clip.pose(f);
    pose.rotations[arm] = pose.rotations[arm] * axes;
    pose.rotations[hand] = conjugate(axes) * pose.rotations[hand];
    pose.translations[hand] = offset_in_file;
  }
  Mannequin mannequin(*Rig::create(clip), clip.pose(0));
  std::array<float, kMannequinNumbers> before, after;
  mannequin.read(clip.pose(0), before);
  mannequin.read(clip.pose(1), after);
  const auto turn = [&](const std::array<float, kMannequinNumbers>& parts) {
    const float* q = &parts[kPartNumbers * hand + 3];
    return Quat{q[0], q[1], q[2], q[3]};
  };
  const float* lower = &after[kPartNumbers * arm + 3];
  const Quat relative = conjugate(Quat{lower[0], lower[1], lower[2], lower[3]}) * turn(after);
  EXPECT_NEAR(length(log_rotation(relative)), 1.0f, 1e-3f);
  // Each part's child is where its own frame says.
  const Vec3 offset = mannequin.offsets()[hand];
  const Vec3 place = rotate(Quat{lower[0], lower[1], lower[2], lower[3]}, offset);
  for (int k = 0; k < 3; ++k) {
    const float along = k == 0 ? place.x : k == 1 ? place.y : place.z;
    EXPECT_NEAR(after[kPartNumbers * hand + static_cast<size_t>(k)],
                after[kPartNumbers * arm + static_cast<size_t>(k)] + along, 1e-4f);
  }
}

TEST(RecordingTest, keeps_the_last_seconds_at_an_even_rate) {
  const Clip clip = test::walking_clip(300, 100);
  Recording recording(clip.skeleton, 1.0);
  EXPECT_EQ(recording.clip(60).frames, 0);
  for (int f = 0; f < clip.frames; ++f) recording.add(clip.pose(f), f % 2 ? 0.015 : 0.005);
  const Clip out = recording.clip(50);
  EXPECT_EQ(out.frames, 51);
  // 1.2 m/s, of which each frame takes a hundredth of a second: a metre and a fifth in the last
  // second, to the unevenness of a frame.
  const Vec3 way = out.pose(50).translations[0] - out.pose(0).translations[0];
  EXPECT_NEAR(way.z, 1.2f, 0.012f);
}

}  // namespace
}  // namespace panache::web
