#include "train/pairing.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "make_takes.h"

namespace panache {
namespace {

TEST(Pairing, a_faster_styled_take_finds_its_phase_and_its_rate) {
  constexpr float kRate = 1.3f;
  const std::vector<Take> takes = {test::make_take("neutral", 200, 0, 1, 0),
                                   test::make_take("old", 90, 1.7f, kRate, 0.4f)};
  const std::vector<Pairing> pairings = pair_takes(takes, {1}, {0});
  ASSERT_FALSE(pairings.empty());
  for (const Pairing& p : pairings) {
    const int frames = static_cast<int>(p.neutral_frames.size());
    double mean_rate = 0;
    for (int i = 4; i < frames - 4; ++i) {
      const float styled_phase = 1.7f + kRate * 0.2f * static_cast<float>(p.first + i);
      const float off =
          std::remainder(0.2f * p.neutral_frames[i] - styled_phase, 2 * std::numbers::pi_v<float>);
      // A neutral frame is 0.2 rad of phase, and the path is made of whole frames before smoothing.
      EXPECT_LT(std::abs(off), 0.2f) << "window at " << p.first << ", frame " << i;
      mean_rate += p.rates[i] / (frames - 8);
    }
    EXPECT_NEAR(mean_rate, kRate, 0.1);
  }
}

TEST(Pairing, windows_cover_the_styled_take_to_its_end) {
  const std::vector<Take> takes = {test::make_take("neutral", 200, 0, 1, 0),
                                   test::make_take("old", 100, 0.5f, 1, 0.4f)};
  const std::vector<Pairing> pairings = pair_takes(takes, {1}, {0});
  EXPECT_EQ(pairings.front().first, 0);
  EXPECT_EQ(pairings.back().first + static_cast<int>(pairings.back().neutral_frames.size()), 100);
}

TEST(Pairing, a_window_never_crosses_from_one_neutral_take_to_another) {
  const std::vector<Take> takes = {test::make_take("neutral", 50, 0, 1, 0),
                                   test::make_take("neutral", 60, 2, 1, 0),
                                   test::make_take("old", 90, 1, 1, 0.4f)};
  for (const Pairing& p : pair_takes(takes, {2}, {0, 1})) {
    for (const float frame : p.neutral_frames) {
      EXPECT_GE(frame, -1);
      EXPECT_LE(frame, static_cast<float>(takes[p.neutral].frames()));
    }
  }
}

TEST(Pairing, without_a_long_enough_neutral_take_there_is_no_pair) {
  const std::vector<Take> takes = {test::make_take("neutral", 10, 0, 1, 0),
                                   test::make_take("old", 90, 1, 1, 0.4f)};
  EXPECT_TRUE(pair_takes(takes, {1}, {0}).empty());
}

TEST(Pairing, styles_are_compared_within_their_own_set_only) {
  std::vector<Take> takes = {test::make_take("neutral", 200, 0, 1, 0),
                             test::make_take("old", 90, 1, 1, 0.4f)};
  takes[1].row.set = 1;
  EXPECT_TRUE(pair_takes(takes, {1}, {0}).empty());
}

}  // namespace
}  // namespace panache
