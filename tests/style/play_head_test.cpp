#include "style/play/playback.h"

#include <cmath>

#include <gtest/gtest.h>

namespace panache {
namespace {

TEST(PlayHead, without_bounds_to_move_in_it_stays_now_whatever_the_style_asks) {
  PlayHead head(0, 0);
  for (const double rate : {0.5, 1.0, 2.0}) EXPECT_EQ(head.advance(0.1, rate, true), 0.1);
  EXPECT_EQ(head.ahead(), 0);
}

TEST(PlayHead, goes_as_fast_as_the_style_asks_and_eases_at_the_bounds) {
  for (const double rate : {0.8, 1.25}) {
    PlayHead head(0.5, 0.25);
    double last = 0.01 * rate;
    for (int i = 0; i < 2000; ++i) {
      const double played = head.advance(0.01, rate, true);
      EXPECT_GE(head.ahead(), -0.5);
      EXPECT_LE(head.ahead(), 0.25);
      // From one step to the next the rate changes by little, never in a jump.
      EXPECT_LT(std::abs(played - last), 0.01 * 0.05);
      last = played;
    }
    // At the bound it goes at the input's own rate.
    EXPECT_NEAR(last, 0.01, 1e-5);
    EXPECT_NEAR(head.ahead(), rate < 1 ? -0.5 : 0.25, 0.02);
  }
}

TEST(PlayHead, between_near_bounds_it_eases_all_the_way_from_their_middle) {
  PlayHead head(0.06, 0.02);
  head.jump(-0.02);
  EXPECT_NEAR(head.room_ahead(), 1, 1e-9);
  EXPECT_NEAR(head.room_behind(), 1, 1e-9);
  head.jump(-0.02);
  EXPECT_NEAR(head.room_ahead(), 1, 1e-9);
  EXPECT_NEAR(head.room_behind(), 0.5, 1e-9);
  head.jump(0.04);
  EXPECT_NEAR(head.room_ahead(), 0.5, 1e-9);
  EXPECT_NEAR(head.room_behind(), 1, 1e-9);
}

TEST(PlayHead, without_a_style_it_returns_to_now_and_then_is_exactly_there) {
  PlayHead head(1, 0.25);
  for (int i = 0; i < 500; ++i) head.advance(0.02, 0.8, true);
  EXPECT_LT(head.ahead(), -0.9);
  double fastest = 0;
  for (int i = 0; i < 1500; ++i) fastest = std::max(fastest, head.advance(0.01, 1, false));
  EXPECT_EQ(head.ahead(), 0);
  EXPECT_EQ(head.advance(0.01, 1, false), 0.01);
  EXPECT_LE(fastest, 0.0111);
}

TEST(PlayHead, no_step_is_so_long_that_a_bound_is_passed_or_time_runs_back) {
  PlayHead head(0.2, 0.1);
  for (const double seconds : {5.0, 0.0, 1e-9, 0.3, 100.0}) {
    for (const double rate : {0.5, 2.0}) {
      EXPECT_GE(head.advance(seconds, rate, true), 0);
      EXPECT_GE(head.ahead(), -0.2);
      EXPECT_LE(head.ahead(), 0.1);
    }
  }
}

}  // namespace
}  // namespace panache
