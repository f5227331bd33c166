// What is trained on.

#include <algorithm>
#include <memory>

#include <gtest/gtest.h>

#include "make_styled_takes.h"
#include "train/removal.h"
#include "train/training_data.h"
#include "train/unlabelled.h"

namespace panache {
namespace {

Take take_of(const std::string& path, const std::string& style, const std::string& content) {
  Take take;
  take.row.path = path;
  take.row.style = style;
  take.row.content = content;
  return take;
}

TEST(ValidationTakes, are_about_a_twentieth_whatever_their_folder) {
  std::vector<Take> here, there;
  for (int i = 0; i < 2000; ++i) {
    const std::string name = "take_" + std::to_string(i) + ".bvh";
    here.push_back(take_of("here/" + name, "old", "walk"));
    there.push_back(take_of("there/" + name, "old", "walk"));
  }
  const std::vector<bool> validates = validation_takes(here);
  const auto count = std::count(validates.begin(), validates.end(), true);
  EXPECT_GT(count, 60);
  EXPECT_LT(count, 140);
  EXPECT_EQ(validation_takes(there), validates);
}

TEST(ValidationTakes, leave_a_take_of_each_action_of_each_style_to_train_on) {
  // All takes that would be kept, were they among others.
  std::vector<Take> many;
  for (int i = 0; i < 2000; ++i) many.push_back(take_of(std::to_string(i), "old", "walk"));
  const std::vector<bool> kept = validation_takes(many);
  std::vector<std::string> names;
  for (size_t i = 0; i < many.size(); ++i) {
    if (kept[i]) names.push_back(many[i].row.path);
  }
  ASSERT_GE(names.size(), 6u);

  std::vector<Take> few = {take_of(names[0], "old", "walk"), take_of(names[1], "old", "run"),
                           take_of(names[2], "sad", "walk"), take_of(names[3], "angry", "walk"),
                           take_of(names[4], "angry", "walk")};
  EXPECT_EQ(validation_takes(few), (std::vector<bool>{false, false, false, false, true}));
  // A take of another set pairs with other neutral takes.
  few = {take_of(names[5], "sad", "run"), take_of("other", "sad", "run")};
  few[1].row.set = 1;
  EXPECT_EQ(validation_takes(few), (std::vector<bool>{false, false}));
  few[1].row.set = 0;
  EXPECT_TRUE(validation_takes(few)[0]);
}

Pairing pairing(std::vector<float> frames, std::vector<float> rates) {
  Pairing made;
  made.styled = 3;
  made.neutral = 8;
  made.first = 20;
  made.neutral_frames = std::move(frames);
  made.rates = std::move(rates);
  return made;
}

TEST(Removal, a_reversed_pairing_has_whole_frames_of_the_neutral_take) {
  // Twice as fast as the styled take.
  const auto back = reversed(pairing({4.5f, 6.5f, 8.5f, 10.5f}, {2, 2, 2, 2}));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->styled, 8);
  EXPECT_EQ(back->neutral, 3);
  EXPECT_EQ(back->first, 5);
  EXPECT_EQ(back->neutral_frames,
            (std::vector<float>{20.25f, 20.75f, 21.25f, 21.75f, 22.25f, 22.75f}));
  EXPECT_EQ(back->rates, std::vector<float>(6, 0.5f));
}

TEST(Removal, where_the_neutral_take_stands_still_the_first_arrival_counts) {
  const auto back = reversed(pairing({0, 1, 1, 1, 2, 3}, {1, 1, 1, 1, 1, 1}));
  ASSERT_TRUE(back);
  EXPECT_EQ(back->neutral_frames, (std::vector<float>{20, 21, 24, 25}));
}

TEST(Removal, a_pairing_of_no_length_has_no_reverse) {
  EXPECT_FALSE(reversed(pairing({4.2f, 4.3f, 4.4f}, {1, 1, 1})));
  EXPECT_FALSE(reversed(pairing({4, 4.5f, 5}, {1, 1, 1})));
}

TEST(Removal, the_take_with_a_style_is_found_on_either_side) {
  std::vector<Take> takes(2);
  takes[0].row.neutral = true;
  Sample sample;
  sample.take = 0, sample.styled = 1;
  EXPECT_EQ(take_with_style(takes, sample), 1);
  sample.take = 1, sample.styled = 0;
  EXPECT_EQ(take_with_style(takes, sample), 1);
}

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
