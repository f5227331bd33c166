#include "recording.h"

#include <gtest/gtest.h>

#include "make_clip.h"

namespace panache::web {
namespace {

TEST(RecordingTest, keeps_the_last_seconds_at_an_even_rate) {
  const Clip clip = test::walking_clip(300, 100);
  Recording recording(clip.skeleton, 1.0);
  EXPECT_EQ(recording.clip(60, 1).frames, 0);
  for (int f = 0; f < clip.frames; ++f) recording.add(clip.pose(f), f % 2 ? 0.015 : 0.005);
  const Clip out = recording.clip(50, 1);
  EXPECT_EQ(out.frames, 51);
  EXPECT_EQ(recording.clip(50, 0.5).frames, 26);
  // 1.2 m/s, of which each frame takes a hundredth of a second: a metre and a fifth in the last
  // second, to the unevenness of a frame.
  const Vec3 travel = out.pose(50).translations[0] - out.pose(0).translations[0];
  EXPECT_NEAR(travel.z, 1.2f, 0.012f);
}

}  // namespace
}  // namespace panache::web
