#include "eval/arrival.h"

#include <cmath>

#include <gtest/gtest.h>

#include "eval/claims.h"
#include "eval/make_swings.h"
#include "eval/toy_system/toy_system.h"

namespace panache {
namespace {

constexpr int kFrames = 120;

// Bends by this much more than the neutral take, in radians at the spine.
Take bent(const std::string& style, float bend, bool test = false) {
  Take take = test::swinging_take(style, kFrames, 0.3f, 1, bend);
  take.row.test = test;
  return take;
}

std::vector<StyleArrival> measure(const std::vector<Take>& training,
                                  const std::vector<Take>& test) {
  const std::vector<TestInput> inputs = {test::swinging_input(kFrames, 0.3f)};
  const WalkSet walks(training, test, inputs, inputs, inputs);
  return *walks.measure(test::ToySystem("toy", {"bowed"}));
}

constexpr size_t kLean = 4;

// The toy bends by 0.5 radians.
TEST(Arrival, is_the_share_of_the_change_of_real_takes) {
  const auto full = measure({bent("neutral", 0), bent("bowed", 0.5f)}, {bent("bowed", 0.5f, true)});
  ASSERT_EQ(full.size(), 1u);
  for (const ArrivedShares& shares : full[0].made) EXPECT_NEAR(shares.movement[kLean], 1, 0.02);
  EXPECT_NEAR(full[0].real.movement[kLean], 1, 0.02);
  // Real takes bend twice as far, or the other way.
  EXPECT_NEAR(measure({bent("neutral", 0), bent("bowed", 1.0f)}, {})[0].made[0].movement[kLean],
              0.5, 0.05);
  EXPECT_LT(measure({bent("neutral", 0), bent("bowed", -0.5f)}, {})[0].made[0].movement[kLean],
            -0.8);
}

TEST(Arrival, what_real_takes_do_not_show_does_not_count) {
  const auto same = measure({bent("neutral", 0), bent("bowed", 0)}, {});
  for (const double share : same[0].made[0].movement) EXPECT_TRUE(std::isnan(share));
  EXPECT_EQ(summarize(same, made_shares<Walks::own>).traits, 0u);
}

TEST(Arrival, is_summed_up_over_all_that_counts) {
  std::vector<StyleArrival> styles(3);
  const double shares[] = {1, 0.4, -0.2};
  for (size_t s = 0; s < 3; ++s) {
    ArrivedShares& own = styles[s].made[0];
    own.movement.fill(kNotMeasured);
    own.movement[kLean] = shares[s];
    own.side = s == 0 ? 0.8 : 0.1;
    styles[s].real.side = s == 0 ? 0.9 : 0.4;  // Too little: theirs by chance.
    own.steps = 1 + static_cast<double>(s);
    styles[s].slowest = 1, styles[s].fastest = 2;
  }
  const ArrivalSummary sum = summarize(styles, made_shares<Walks::own>);
  EXPECT_EQ(sum.traits, 3u);
  EXPECT_EQ(sum.median, 0.4);
  EXPECT_NEAR(sum.below_half, 2.0 / 3, 1e-9);
  EXPECT_NEAR(sum.wrong_sign, 1.0 / 3, 1e-9);
  EXPECT_EQ(sum.side, 0.8);
  EXPECT_EQ(sum.sided, 1u);
  EXPECT_EQ(sum.in_step, 2u);
}

TEST(Claims, of_a_description_hold_where_the_walker_shows_them) {
  StyleArrival style;
  style.change = {20, 0, 0, 0, 0, -0.5, 0};
  Movement& shown = style.made[static_cast<size_t>(Walks::walker)].movement;
  shown = {0.9, 0, 0, 0, 0, 0.6, 0};
  style.made[static_cast<size_t>(Walks::walker)].steps = 1.6;
  EXPECT_TRUE(unshown("high knees", style).empty());
  EXPECT_TRUE(unshown("a heavy walk", style).empty());
  EXPECT_EQ(unshown("slow steps, high knees", style), (std::vector<std::string>{"slow"}));
  EXPECT_EQ(unshown("fast", style), (std::vector<std::string>{"fast"}));
}

}  // namespace
}  // namespace panache
