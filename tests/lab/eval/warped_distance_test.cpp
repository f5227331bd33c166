#include "eval/performer_judges.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "learn/make_walk_take.h"

namespace panache {
namespace {

Take part_of(const Take& take, int first, int frames, int stride = 1) {
  Take part;
  for (int f = 0; f < frames; ++f) part.body.push_back(take.body[first + f * stride]);
  return part;
}

TEST(WarpedDistance, a_part_of_the_real_take_is_found_wherever_it_begins) {
  const Take real = test::walk_take("old", "walk", 200, 0.3f);
  EXPECT_EQ(warped_distance(part_of(real, 37, 100), real), 0);
  EXPECT_EQ(warped_distance(part_of(real, 37, 20), real), 0);
  EXPECT_EQ(warped_distance(real, part_of(real, 0, 200)), 0);
  // One frame is a motion too.
  EXPECT_EQ(warped_distance(part_of(real, 5, 1), real), 0);
}

TEST(WarpedDistance, half_and_double_speed_cost_little) {
  const Take real = test::walk_take("old", "walk", 200, 0.3f);
  EXPECT_EQ(warped_distance(part_of(real, 10, 90, 2), real), 0);
  // Every other frame of the slow take lies half-way between two.
  const Take fast = part_of(real, 0, 100, 2);
  const double slow = warped_distance(part_of(real, 0, 120), fast);
  EXPECT_LT(slow, 2);
  EXPECT_GT(slow, 0);
}

TEST(WarpedDistance, what_differs_in_every_frame_is_measured_in_centimetres) {
  const Take real = test::walk_take("old", "walk", 150, 0.3f);
  Take raised = part_of(real, 20, 100);
  for (HumanPositions& pose : raised.body) {
    for (Vec3& joint : pose) joint.y += 0.5f;
  }
  // Every joint is half a metre from its own place, and of other instants no nearer but for a bit.
  EXPECT_LE(warped_distance(raised, real), 50.001);
  EXPECT_GT(warped_distance(raised, real), 49);
}

TEST(WarpedDistance, standing_still_is_no_way_to_be_near_a_walk) {
  const Take real = test::walk_take("old", "walk", 150, 0.3f);
  Take still = part_of(real, 0, 60);
  std::fill(still.body.begin(), still.body.end(), real.body[30]);
  EXPECT_GT(warped_distance(still, real), 1);
}

}  // namespace
}  // namespace panache
