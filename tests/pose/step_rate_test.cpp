#include "pose/step_rate.h"

#include <gtest/gtest.h>

#include "make_clip.h"

namespace panache {
namespace {

// Whether a walk of 2 steps a second is doubted where it plays `times` as fast.
std::string doubt(Clip clip, double times) {
  clip.frame_time /= times;
  return doubtful_rate(clip, *Rig::create(clip)).value_or("");
}

TEST(StepRate, a_walk_is_doubted_far_from_its_rate_and_not_near_it) {
  for (const double fps : {30.0, 24.0, 120.0}) {
    const Clip walk = test::walking_clip(static_cast<int>(8 * fps), fps);
    for (const double times : {0.25, 0.2, 4.0, 2.5, 8.0}) {
      EXPECT_NE(doubt(walk, times), "") << times << " at " << fps;
    }
    for (const double times : {0.8, 1.0, 1.25}) EXPECT_EQ(doubt(walk, times), "") << times;
  }
}

TEST(StepRate, two_steps_whose_frames_became_seconds_are_doubted) {
  for (const double fps : {20.0, 30.0, 60.0}) {
    const Clip walk = test::walking_clip(static_cast<int>(1.1 * fps), fps);
    for (const double times : {1 / 20.0, 1 / 60.0}) {
      EXPECT_NE(doubt(walk, times).find("too slow"), std::string::npos) << times << " at " << fps;
    }
    for (const double times : {0.5, 1.0, 2.0}) EXPECT_EQ(doubt(walk, times), "") << times;
  }
}

TEST(StepRate, the_message_says_what_was_found_and_the_cure) {
  EXPECT_EQ(
      doubt(test::walking_clip(240), 4),
      "expected steps that legs of 0.8 m can take, found 8 a second, too fast to keep balance; "
      "if it was not recorded at 120 frames a second, give its rate");
  EXPECT_NE(doubt(test::walking_clip(240), 0.25).find("found 0.5 a second, too slow"),
            std::string::npos);
}

TEST(StepRate, a_clip_without_steps_says_nothing) {
  Clip clip = test::walking_clip(100);
  for (const int frames : {1, 2, 7, 20}) {
    Clip shorter = clip;
    shorter.resize(frames);
    for (const double times : {0.1, 1.0, 10.0}) EXPECT_EQ(doubt(shorter, times), "");
  }
  for (int f = 0; f < clip.frames; ++f) {
    std::ranges::copy(clip.pose(0).rotations, clip.pose(f).rotations.begin());
  }
  EXPECT_EQ(doubt(clip, 10), "");
}

}  // namespace
}  // namespace panache
