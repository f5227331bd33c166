#include "train/batches.h"

#include <cmath>

#include <gtest/gtest.h>

#include "known_recipes.h"
#include "learn/make_takes.h"

namespace panache {
namespace {

constexpr int kMark =
    StyleDelta::kSize - 1;  // The turn rate: no made take turns, so it can tell cells apart.

// Frame i of take `styled` with frame i of take `neutral`, throughout.
Pairing straight(int styled, int neutral, int frames) {
  Pairing pairing;
  pairing.styled = styled;
  pairing.neutral = neutral;
  for (int f = 0; f < frames; ++f) pairing.neutral_frames.push_back(static_cast<float>(f));
  pairing.rates.assign(frames, 1.0f);
  return pairing;
}

// A take whose turn rate is `mark` throughout, so that its samples are known by their targets.
Take marked(const std::string& style, const std::string& content, int frames, float mark) {
  Take take = test::make_take(style, frames, 0.3f, 1, style == "neutral" ? 0 : 0.4f);
  take.row.content = content;
  const size_t numbers = pose_feature_count(PoseLayout::positions);
  for (int f = 0; f < frames; ++f) take.pose_features[(f + 1) * numbers - 1] = mark;
  return take;
}

class BatchesTest : public testing::Test {
 protected:
  // "old" walks long, waves less and bows a little; "sad" walks a little. The frames beyond the
  // round numbers: the trimmed ends, and one without a next.
  static constexpr int kWalk = 900, kWave = 100, kBow = 25, kSad = 49, kEnds = 2 * kTrimFrames + 1;

  BatchesTest()
      : takes_{marked("neutral", "walk", 1000, 0),      marked("neutral", "wave", 200, 0),
               marked("neutral", "bow", 100, 0),        marked("old", "walk", kWalk + kEnds, 1),
               marked("old", "wave", kWave + kEnds, 2), marked("old", "bow", kBow + kEnds, 3),
               marked("sad", "walk", kSad + kEnds, 4)},
        set_(takes_,
             {straight(3, 0, kWalk + kEnds), straight(4, 1, kWave + kEnds),
              straight(5, 2, kBow + kEnds), straight(6, 0, kSad + kEnds)},
             {"old", "sad"}, test::kPanache, false) {
    settings_.by_style = true;
    settings_.size = 512;
    units_.mean.assign(StyleDelta::kSize, 0.0f);
    units_.scale.assign(StyleDelta::kSize, 1.0f);
    for (size_t i = 0; i < set_.samples().size(); ++i) all_.push_back(static_cast<int>(i));
  }
  BatchMaker maker() const { return BatchMaker(set_, all_, 2, settings_, units_); }

  const std::vector<Take> takes_;
  const SampleSet set_;
  BatchSettings settings_;
  OutputUnits units_;
  std::vector<int> all_;
};

TEST_F(BatchesTest, every_action_of_a_style_gets_the_square_root_of_its_share) {
  const BatchMaker batches = maker();
  Random random(7);
  double counts[5] = {}, rows = 0;
  for (int b = 0; b < 60; ++b) {
    const Batch batch = batches.make(random);
    for (int r = 0; r < settings_.size; ++r) {
      ++counts[std::lround(batch.pose[r][kMark].item<float>())];
      ++rows;
    }
  }
  const double total = std::sqrt(kWalk) + std::sqrt(kWave) + std::sqrt(kBow) + std::sqrt(kSad);
  // 15,360 pairs are drawn: a deviation of 0.004 at most.
  EXPECT_NEAR(counts[1] / rows, std::sqrt(kWalk) / total, 0.016);
  EXPECT_NEAR(counts[2] / rows, std::sqrt(kWave) / total, 0.016);
  EXPECT_NEAR(counts[3] / rows, std::sqrt(kBow) / total, 0.016);
  EXPECT_NEAR(counts[4] / rows, std::sqrt(kSad) / total, 0.016);
}

TEST_F(BatchesTest, rows_are_grouped_by_style_in_pairs_of_neighbouring_frames) {
  const BatchMaker batches = maker();
  Random random(3);
  const Batch batch = batches.make(random);
  ASSERT_EQ(batch.group_sizes.size(), 2u);
  EXPECT_EQ(batch.group_sizes[0] + batch.group_sizes[1], settings_.size);
  EXPECT_GT(batch.group_sizes[1], 0);
  for (int r = 0; r < settings_.size; ++r) {
    const bool sad = std::lround(batch.pose[r][kMark].item<float>()) == 4;
    EXPECT_EQ(sad, r >= batch.group_sizes[0]) << "row " << r;
  }
  // Each window as it is, so the second of a pair is found right after the first.
  std::vector<float> window(set_.inputs());
  for (int r = 0; r < 20; r += 2) {
    const torch::Tensor first = batch.inputs[r], second = batch.inputs[r + 1];
    bool found = false;
    for (size_t i = 0; i + 1 < all_.size() && !found; ++i) {
      const Batch pair = batches.plain({static_cast<int>(i), static_cast<int>(i + 1)});
      found = torch::equal(pair.inputs[0], first) && torch::equal(pair.inputs[1], second);
    }
    EXPECT_TRUE(found) << "row " << r;
  }
}

TEST_F(BatchesTest, the_same_random_numbers_make_the_same_batch) {
  settings_.mirrored = settings_.disturbed = true;
  const BatchMaker batches = maker();
  Random first(5), second(5), third(6);
  const Batch a = batches.make(first), b = batches.make(second), c = batches.make(third);
  EXPECT_TRUE(torch::equal(a.inputs, b.inputs));
  EXPECT_TRUE(torch::equal(a.pose, b.pose));
  EXPECT_FALSE(torch::equal(a.inputs, c.inputs));
}

TEST_F(BatchesTest, normalised_inputs_are_held_within_the_clip) {
  const Batch free = maker().plain({0, 100});
  const float largest = free.inputs.abs().max().item<float>();
  ASSERT_GT(largest, 0.5f);
  settings_.input_clip = 0.5f;
  const Batch held = maker().plain({0, 100});
  EXPECT_TRUE(torch::equal(held.inputs, free.inputs.clamp(-0.5, 0.5)));
}

TEST_F(BatchesTest, a_style_vector_follows_the_window_where_it_is_an_input) {
  std::vector<Take> takes = takes_;
  for (Take& take : takes) write_numbers(PoseLayout::rotations, take);
  const SampleSet set(takes, {straight(4, 1, kWave + kEnds), straight(6, 0, kSad + kEnds)},
                      {"old", "sad"}, test::kSmith2019, false);
  const int sad = static_cast<int>(set.samples().size()) - 1;
  const Batch batch =
      BatchMaker(set, {0, sad}, 2, settings_, output_units(set, {0, sad})).plain({0, sad});
  ASSERT_EQ(batch.inputs.size(1), set.inputs() + 3);
  // Neutral, old, sad.
  const torch::Tensor style = batch.inputs.slice(1, set.inputs());
  EXPECT_TRUE(torch::equal(style[0], torch::tensor({0.0f, 1.0f, 0.0f})));
  EXPECT_TRUE(torch::equal(style[1], torch::tensor({0.0f, 0.0f, 1.0f})));
}

TEST_F(BatchesTest, half_of_the_rows_are_mirrored_with_their_feet) {
  settings_.mirrored = true;
  const BatchMaker batches = maker();
  Random random(2);
  const Batch batch = batches.make(random);
  // A mirrored turn is the other way round, so the marks of mirrored rows are negative.
  const torch::Tensor flipped = batch.pose.select(1, kMark).lt(0);
  const double share = flipped.sum().item<double>() / settings_.size;
  EXPECT_NEAR(share, 0.5, 0.13);  // 256 draws: a deviation of 0.03.
  for (int r = 0; r < settings_.size; r += 2) {
    EXPECT_EQ(flipped[r].item<bool>(), flipped[r + 1].item<bool>()) << "a pair stays one";
  }
}

}  // namespace
}  // namespace panache
