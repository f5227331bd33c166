#include <cmath>

#include <gtest/gtest.h>

#include "make_clip.h"
#include "pose/history.h"
#include "pose/step_rate.h"

namespace panache {
namespace {

// A body that moves and turns smoothly: any rate must show the same window.
HumanPositions body_at(double seconds) {
  HumanPositions body;
  for (int j = 0; j < kHumanJoints; ++j) {
    const float phase = static_cast<float>(seconds) * 4 + static_cast<float>(j);
    body[j] = {0.1f * std::sin(phase), 1 + 0.05f * std::cos(phase), 0.01f * static_cast<float>(j)};
  }
  return body;
}
RootPose root_at(double seconds) {
  const float s = static_cast<float>(seconds);
  return {{0.3f * s, 0, 1.2f * s}, 0.5f * s};
}

std::vector<float> window_after(double fps, double seconds) {
  PoseHistory history(PoseLayout::positions);
  const int frames = static_cast<int>(std::lround(seconds * fps));
  for (int f = 0; f <= frames; ++f) history.push(f / fps, body_at(f / fps), root_at(f / fps));
  std::vector<float> window(size_t(kWindowPoses) * pose_feature_count(PoseLayout::positions));
  history.window(window);
  return window;
}

TEST(History, a_window_holds_six_poses_a_twentieth_of_a_second_apart) {
  const std::vector<float> window = window_after(120, 1);
  for (int k = 0; k < kWindowPoses; ++k) {
    const HumanPositions expected = body_at(1 - k * kWindowSpacing);
    for (int j = 0; j < kHumanJoints; ++j) {
      EXPECT_NEAR(window[66 * k + 3 * j], expected[j].x, 1e-4) << "pose " << k << " joint " << j;
      EXPECT_NEAR(window[66 * k + 3 * j + 1], expected[j].y, 1e-4);
    }
  }
}

TEST(History, every_rate_shows_the_same_window) {
  const std::vector<float> reference = window_after(1000, 1);
  for (const double fps : {24.0, 25.0, 30.0, 50.0, 60.0, 90.0, 120.0, 240.0}) {
    const std::vector<float> window = window_after(fps, 1);
    for (size_t i = 0; i < window.size(); ++i) {
      // Straight lines between frames miss a curve of acceleration a by a dt^2 / 8: here 0.4 mm at
      // 24 fps in positions, and twice that over 0.05 s in velocities.
      EXPECT_NEAR(window[i], reference[i], i % 66 < 63 ? 5e-4 : 2e-2)
          << fps << " fps, number " << i;
    }
  }
}

TEST(History, between_the_poses_of_a_slow_input_the_window_lies_on_straight_lines) {
  // At 8 poses a second, several of the window's times lie between the same two.
  constexpr double kGap = 1.0 / 8;
  const std::vector<float> window = window_after(8, 1);
  for (int k = 0; k < kWindowPoses; ++k) {
    const double time = 1 - k * kWindowSpacing, before = std::floor(time / kGap) * kGap;
    const float t = static_cast<float>((time - before) / kGap);
    for (int j = 0; j < kHumanJoints; ++j) {
      const Vec3 expected = lerp(body_at(before)[j], body_at(before + kGap)[j], t);
      // Rounding only.
      EXPECT_NEAR(window[66 * k + 3 * j], expected.x, 1e-6) << "pose " << k << " joint " << j;
    }
  }
}

TEST(History, velocity_and_turn_rate_are_those_of_the_body) {
  const std::vector<float> window = window_after(60, 1);
  // The body goes at 0.3 m/s in x and 1.2 in z while it faces 0.5 rad to the left.
  const float speed = std::hypot(window[63], window[64]);
  EXPECT_NEAR(speed, std::hypot(0.3f, 1.2f), 1e-3);
  EXPECT_NEAR(window[65], 0.5f, 1e-3);
}

TEST(History, before_the_first_pose_the_first_pose_rests) {
  PoseHistory history(PoseLayout::positions);
  history.push(0, body_at(0), root_at(0));
  std::vector<float> window(size_t(kWindowPoses) * 66);
  EXPECT_EQ(history.window(window), 0);
  for (int k = 1; k < kWindowPoses; ++k) {
    for (int i = 0; i < 66; ++i) EXPECT_EQ(window[66 * k + i], window[i]);
  }
  EXPECT_EQ(window[63], 0);
}

TEST(History, repeated_and_crowded_times_lose_no_reach) {
  PoseHistory history(PoseLayout::positions);
  for (int f = 0; f <= 2000; ++f) {
    history.push(f / 2000.0, body_at(f / 2000.0), root_at(f / 2000.0));
    history.push(f / 2000.0, body_at(f / 2000.0), root_at(f / 2000.0));
  }
  std::vector<float> window(size_t(kWindowPoses) * 66);
  EXPECT_NEAR(history.window(window), std::hypot(0.3f, 1.2f), 1e-2);
}

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
