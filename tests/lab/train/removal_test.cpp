#include "train/removal.h"

#include <gtest/gtest.h>

namespace panache {
namespace {

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

}  // namespace
}  // namespace panache
