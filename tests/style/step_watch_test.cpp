// A style's tempo is that of its steps: who stands keeps the input's time.

#include "style/stages/input_watch.h"

#include <cmath>

#include <gtest/gtest.h>

namespace panache {
namespace {

// Feet that step by turns at this speed over the ground, m/s, for `seconds`, at this rate.
void walk(StepWatch& watch, float speed, double seconds, double rate = 60) {
  static double clock = 0;
  const double cycle = 1;
  for (int f = 0; f < seconds * rate; ++f) {
    clock += 1 / rate;
    HumanPositions world{};
    for (int side = 0; side < 2; ++side) {
      // Half of the cycle a foot stands, in the other half it goes twice as fast as the body.
      const double phase = clock / cycle + 0.5 * side, whole = std::floor(phase);
      const double share = std::max(0.0, 2 * (phase - whole) - 1);
      const HumanJoint foot = side == 0 ? HumanJoint::left_foot : HumanJoint::right_foot;
      world[index(foot)] = {0, 0.1f, speed * static_cast<float>(cycle * (whole + share))};
    }
    watch.step(world, {1 / rate, static_cast<float>(1 / rate), f == 0 && clock < 1.5 / rate});
  }
}

TEST(StepWatch, tells_a_walk_from_standing_and_eases_between_them) {
  StepWatch watch;
  watch.step({}, {0, 0, true});
  EXPECT_EQ(watch.amount(), 0);
  walk(watch, 0.8f, 2);
  EXPECT_EQ(watch.amount(), 1);
  walk(watch, 0, 0.1);
  EXPECT_GT(watch.amount(), 0.9f);
  float before = watch.amount();
  for (int i = 0; i < 40; ++i) {
    walk(watch, 0, 1 / 60.0);
    EXPECT_LE(watch.amount(), before);
    EXPECT_GT(watch.amount(), before - 0.1f);
    before = watch.amount();
  }
  walk(watch, 0, 1);
  EXPECT_EQ(watch.amount(), 0);
}

TEST(StepWatch, shifting_the_weight_is_no_step_at_any_rate) {
  for (const double rate : {30.0, 120.0}) {
    StepWatch watch;
    watch.step({}, {0, 0, true});
    walk(watch, 0, 0.1, rate);
    walk(watch, 0.1f, 2, rate);
    EXPECT_EQ(watch.amount(), 0) << rate;
  }
}

}  // namespace
}  // namespace panache
