#include "style/play/play_clip.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace panache {
namespace {

// A round whose rate swings about `rate`, with a flight from phase 10 to 16.
std::vector<PaceSample> round_at(double rate, double swing, int length) {
  std::vector<PaceSample> round;
  for (double phase = 0; phase < length; phase += 0.9) {
    const bool flies = phase >= 10 && phase <= 16;
    const double now = flies ? 1 : rate + swing * std::sin(6.2831853 * phase / length);
    round.push_back({phase, now, flies ? 1.0f : 0.0f});
  }
  return round;
}

TEST(LoopSchedule, a_round_takes_whole_frames_from_end_to_end) {
  for (const double rate : {0.55, 0.8, 0.97, 1.03, 1.3, 1.9}) {
    const std::vector<double> phases = loop_schedule(round_at(rate, 0.1, 32), 32, 0);
    EXPECT_EQ(phases.front(), 0);
    EXPECT_EQ(phases.back(), 32);
    EXPECT_NEAR(static_cast<double>(phases.size() - 1), 7 + 25 / rate, 4) << rate;
    for (size_t i = 1; i < phases.size(); ++i) {
      const double step = phases[i] - phases[i - 1];
      EXPECT_GT(step, 0.4);
      // A flight keeps its time.
      const bool flies = phases[i - 1] > 10.5 && phases[i] < 15.5;
      EXPECT_NEAR(flies ? step : 1, 1, 1e-9) << rate;
      EXPECT_NEAR(flies ? phases[i] : 0, flies ? std::round(phases[i]) : 0, 1e-9) << rate;
    }
  }
}

TEST(LoopSchedule, a_round_without_a_tempo_has_the_frames_of_the_input) {
  const std::vector<double> phases = loop_schedule({{0, 1, 0}, {20, 1, 1}}, 32, 0);
  ASSERT_EQ(phases.size(), 33u);
  for (int i = 0; i < 33; ++i) EXPECT_EQ(phases[static_cast<size_t>(i)], i);
}

TEST(LoopSchedule, the_number_of_frames_stays_where_either_would_do) {
  const auto frames = [](double wanted, int before) {
    return loop_schedule({{0, 32 / wanted, 0}}, 32, before).size() - 1;
  };
  EXPECT_EQ(frames(40.4, 0), 40u);
  EXPECT_EQ(frames(40.55, 40), 40u);
  EXPECT_EQ(frames(40.45, 41), 41u);
  EXPECT_EQ(frames(45, 39), 45u);
}

}  // namespace
}  // namespace panache
