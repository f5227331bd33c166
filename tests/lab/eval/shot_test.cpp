#include "eval/shot.h"

#include <cmath>

#include <gtest/gtest.h>

#include "eval/make_aligned.h"
#include "pose/limb.h"

namespace panache {
namespace {

using enum HumanJoint;

// Stands still on both feet, hands before the chest and 10 cm apart.
Take standing() {
  Take take = test::walk_take("neutral", "walk", 60, 0);
  HumanPositions body = take.body[0];
  for (int side = 0; side < 2; ++side) {
    const float x = side == 0 ? 0.1f : -0.1f;
    body[index(kUpperLegs[side])] = {x, 0.88f, 0};
    body[index(kLowerLegs[side])] = {x, 0.45f, 0.02f};
    body[index(kAnkles[side])] = {x, 0.08f, 0};
    body[index(kToes[side])] = {x, 0.02f, 0.14f};
    body[index(kLowerArms[side])] = {2.5f * x, 1.1f, 0.05f};
    body[index(kHands[side])] = {x / 2, 1.2f, 0.3f};
  }
  body[index(hips)] = {0, 0.9f, 0};
  for (int f = 0; f < take.frames(); ++f) {
    take.body[f] = body;
    take.root[f] = {};
  }
  return take;
}

template <typename Change>
Take with(Take take, const Change& change) {
  for (HumanPositions& body : take.body) change(body);
  return take;
}

const std::vector<float>& of(const ShotValues& values, ShotMeasure measure) {
  return values[static_cast<size_t>(measure)];
}

TEST(Shot, the_input_itself_keeps_everything) {
  const Take take = standing();
  for (const std::vector<float>& values : measure_shot(take, take)) {
    for (const float value : values) EXPECT_LE(value, 0);
  }
}

TEST(Shot, a_foot_that_is_lifted_and_turned_shows_in_its_own_measures) {
  const Take from = standing();
  const Take to = with(from, [](HumanPositions& body) {
    body[index(left_foot)].y += 0.05f;
    body[index(left_toes)] = {0.24f, 0.04f, 0};
  });
  const ShotValues values = measure_shot(from, to);
  EXPECT_NEAR(of(values, ShotMeasure::standing_toe)[0], 2, 1e-3);
  EXPECT_NEAR(of(values, ShotMeasure::standing_lift)[0], 5, 1e-3);
  EXPECT_NEAR(of(values, ShotMeasure::standing_turn)[0], 90, 1e-2);
  EXPECT_EQ(of(values, ShotMeasure::standing_turn)[1], 0);  // The other foot.
  EXPECT_TRUE(of(values, ShotMeasure::walking_toe).empty());
  EXPECT_TRUE(of(values, ShotMeasure::seat_hips).empty());
}

TEST(Shot, a_seat_and_its_feet_are_measured_by_height) {
  const Take from = with(standing(), [](HumanPositions& body) {
    body[index(hips)] = {0, 0.5f, -0.3f};
  });
  const Take to = with(from, [](HumanPositions& body) {
    body[index(hips)].y -= 0.04f;
    body[index(right_toes)].y += 0.03f;
  });
  const ShotValues values = measure_shot(from, to);
  EXPECT_NEAR(of(values, ShotMeasure::seat_hips)[0], 4, 1e-3);
  EXPECT_NEAR(of(values, ShotMeasure::seat_toe)[0], 0, 1e-3);
  EXPECT_NEAR(of(values, ShotMeasure::seat_toe)[1], 3, 1e-3);
  EXPECT_TRUE(of(values, ShotMeasure::standing_toe).empty());
}

TEST(Shot, hands_are_measured_by_their_distance_where_they_are_near) {
  const Take from = standing();
  const Take to = with(from, [](HumanPositions& body) { body[index(left_hand)].x += 0.07f; });
  EXPECT_NEAR(of(measure_shot(from, to), ShotMeasure::hands)[0], 7, 1e-3);
  // Hands that are far apart may go anywhere.
  EXPECT_TRUE(
      of(measure_shot(with(from, [](HumanPositions& body) { body[index(left_hand)].x += 0.3f; }),
                      to),
         ShotMeasure::hands)
          .empty());
}

TEST(Shot, depth_in_the_body_counts_beyond_the_inputs) {
  const Take from = standing();
  const auto crossed = [](HumanPositions& body) {
    body[index(left_lower_leg)].x = body[index(right_lower_leg)].x + 0.05f;
  };
  const Take to = with(from, crossed);
  EXPECT_GT(of(measure_shot(from, to), ShotMeasure::in_body)[0], 2);
  EXPECT_LE(of(measure_shot(to, to), ShotMeasure::in_body)[0], 0);
}

}  // namespace
}  // namespace panache
