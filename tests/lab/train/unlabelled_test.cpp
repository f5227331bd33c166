#include "train/unlabelled.h"

#include <memory>

#include <gtest/gtest.h>

#include "make_styled_takes.h"

namespace panache {
namespace {

constexpr int kNumbers = pose_feature_count(PoseLayout::positions);

using Sequence = std::array<float, kSequenceNumbers>;

// A take that stands still with all joints at this height.
Take still(float height, float chest = 0, int frames = 90) {
  Take take;
  HumanPositions body;
  body.fill({0, height, 0});
  body[index(HumanJoint::chest)].y = chest;
  take.body.assign(static_cast<size_t>(frames), body);
  take.root.resize(static_cast<size_t>(frames));
  write_numbers(PoseLayout::positions, take);
  return take;
}

Sequence draw(const UnlabelledMotion& motion, float spliced, Random& random) {
  Sequence sequence;
  motion.draw(spliced, random, sequence);
  return sequence;
}

float height(const Sequence& sequence, HumanJoint joint, int pose = 0) {
  return sequence[static_cast<size_t>(pose * kNumbers + 3 * index(joint) + 1)];
}

TEST(UnlabelledMotion, short_takes_are_not_drawn_and_long_ones_not_without_limit) {
  const std::vector<Take> takes = {still(1, 0, 100), still(2, 0, 400), still(3, 0, 4000),
                                   still(4, 0, 45)};
  const UnlabelledMotion motion(takes, {}, {});
  Random random(1);
  std::array<int, 5> drawn{};
  for (int i = 0; i < 1800; ++i) {
    ++drawn[static_cast<size_t>(height(draw(motion, 0, random), HumanJoint::hips))];
  }
  // A ninth, four, four: 40 is three deviations.
  EXPECT_NEAR(drawn[1], 200, 40);
  EXPECT_NEAR(drawn[2], 800, 64);
  EXPECT_NEAR(drawn[3], 800, 64);
  EXPECT_EQ(drawn[4], 0);
  EXPECT_TRUE(UnlabelledMotion({still(4, 0, 45)}, {}, {}).empty());
}

TEST(UnlabelledMotion, a_sequence_is_a_second_of_the_take_one_window_after_the_other) {
  // Hips that rise by one a frame tell the frame.
  Take take = still(0, 0, 300);
  for (int f = 0; f < take.frames(); ++f) take.body[f][0].y = static_cast<float>(f);
  write_numbers(PoseLayout::positions, take);
  const std::vector<Take> takes = {take};
  const UnlabelledMotion motion(takes, {}, {});
  Random random(2);
  for (int i = 0; i < 50; ++i) {
    const Sequence sequence = draw(motion, 0, random);
    const float step =
        height(sequence, HumanJoint::hips, kWindowPoses) - height(sequence, HumanJoint::hips, 0);
    EXPECT_NEAR(step, 2, 0.8);  // Two frames, played up to four deviations faster or slower.
    for (int k = 1; k < kWindowPoses; ++k) {
      EXPECT_NEAR(height(sequence, HumanJoint::hips, k - 1) - height(sequence, HumanJoint::hips, k),
                  1.5, 1e-3);
    }
  }
}

TEST(UnlabelledMotion, spliced_parts_hang_on_the_other_body) {
  const std::vector<Take> takes = {still(1, 10)}, neutral = {still(5, 20), still(7, 30)};
  const UnlabelledMotion motion(takes, neutral, {0});  // The second is not lent.
  Random random(3);
  int lent = 0, borrowed = 0, one_arm = 0, upper = 0;
  constexpr int kDraws = 1000;
  for (int i = 0; i < kDraws; ++i) {
    const Sequence sequence = draw(motion, 0.5f, random);
    const float left = height(sequence, HumanJoint::left_hand);
    const float right = height(sequence, HumanJoint::right_hand);
    const bool own = height(sequence, HumanJoint::hips) == 1;
    const float home = own ? 1 : 5;
    EXPECT_EQ(height(sequence, HumanJoint::left_foot), home);
    // All above the hips of the other take, whose hands are at its hips and its chest is 9 or 15
    // above them,
    if (height(sequence, HumanJoint::chest) == home + (own ? 15 : 9)) {
      EXPECT_EQ(left, home);
      EXPECT_EQ(right, home);
      EXPECT_EQ(height(sequence, HumanJoint::head), home);
      ++(own ? lent : borrowed), ++upper;
      continue;
    }
    // or its arms, 15 below its chest or 9, below the chest of the other.
    const float away = own ? 10 - 15 : 20 - 9;
    EXPECT_TRUE(left == home || left == away);
    EXPECT_TRUE(right == home || right == away);
    if (left == home && right == home) {
      EXPECT_TRUE(own);  // What is not spliced is the motion itself.
      continue;
    }
    ++(own ? lent : borrowed);
    one_arm += left != right;
  }
  EXPECT_NEAR(lent + borrowed, kDraws / 2, 50);
  EXPECT_NEAR(lent, borrowed, 70);
  EXPECT_NEAR(upper, 0.5 * (lent + borrowed), 45);
  EXPECT_NEAR(one_arm, 0.4 * (lent + borrowed - upper), 35);
}

}  // namespace
}  // namespace panache
