#include "style/stages/filter.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace panache {
namespace {

constexpr float kFrame = 1.0f / 60;

StyleDelta turned(float angle) {
  StyleDelta delta;
  delta.rotations.fill({angle, 0, 0});
  return delta;
}

// All joints go up and down at `speed`.
HumanPositions moving_body(int step, float speed) {
  HumanPositions body{};
  for (Vec3& joint : body) joint.y = (step % 20 < 10 ? 1.0f : -1.0f) * speed * kFrame;
  for (Vec3& joint : body) joint.x = speed * kFrame * static_cast<float>(step);
  return body;
}

// How far a filter has come to a turn of 1 rad, 0.1 s after it was asked for.
float share_after(float speed, float gate, float smoothing_seconds = 0.04f) {
  OutputFilter filter(smoothing_seconds);
  int step = 0;
  const auto go = [&](float angle, int steps) {
    for (int i = 0; i < steps; ++i, ++step) {
      filter.step(turned(angle), 0, gate, moving_body(step, speed), {kFrame, kFrame, step == 0});
    }
  };
  go(0, 60);
  go(1, 6);
  return filter.delta().rotations[0].x;
}

TEST(Filter, a_change_of_a_body_that_moves_as_much_is_smoothed_as_usual) {
  EXPECT_NEAR(share_after(100, 0.5f), 1 - std::exp(-0.1f / 0.04f), 1e-3f);
}

TEST(Filter, a_change_of_a_body_that_hardly_moves_takes_up_to_eleven_times_as_long) {
  const float share = share_after(0.02f, 0.5f);
  EXPECT_LT(share, 0.5f);
  EXPECT_GT(share, 0.99f * (1 - std::exp(-0.1f / 0.44f)));
  EXPECT_LT(share, share_after(10, 0.5f));
}

TEST(Filter, a_change_of_captured_motion_is_smoothed_as_usual) {
  EXPECT_NEAR(share_after(0.02f, 1), 1 - std::exp(-0.1f / 0.04f), 1e-3f);
}

TEST(Filter, without_smoothing_nothing_is_smoothed) { EXPECT_EQ(share_after(0, 0.5f, 0), 1); }

TEST(Filter, what_was_no_number_is_forgotten) {
  OutputFilter filter(0.04f);
  for (int step = 0; step < 200; ++step) {
    StyleDelta delta = turned(0.1f);
    if (step == 50) delta.rotations[3] = {NAN, 3e38f, -3e38f};
    filter.step(delta, 0, 1, moving_body(step, 1), {kFrame, kFrame, step == 0});
    if (step == 50) continue;
    ASSERT_TRUE(std::isfinite(filter.delta().rotations[0].x)) << step;
  }
  EXPECT_NEAR(filter.delta().rotations[0].x, 0.1f, 1e-3f);
}

}  // namespace
}  // namespace panache
