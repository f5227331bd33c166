// A performer who walks slowly and fast teaches how fast a style is beside both.

#include "train/neutral_tempos.h"

#include <cmath>

#include <gtest/gtest.h>

#include "known_recipes.h"
#include "make_styled_takes.h"

namespace panache {
namespace {

// The steady walk of the tests, `speed` times as fast.
Take walk(const std::string& style, float speed, int frames = 150) {
  const Take usual = test::styled_take("neutral", "walk", 0, static_cast<int>(frames * 2.5));
  Take take = usual;
  take.row.style = style;
  take.row.neutral = style == "neutral";
  take.row.manifest = "takes.csv";
  take.body.resize(frames), take.rotations.resize(frames);
  take.root.resize(frames), take.contacts.resize(frames);
  for (int f = 0; f < frames; ++f) {
    const auto from = static_cast<size_t>(std::lround(static_cast<float>(f) * speed));
    take.body[f] = usual.body[from];
    take.rotations[f] = usual.rotations[from];
    take.root[f] = usual.root[from];
    take.contacts[f] = usual.contacts[from];
  }
  write_numbers(PoseLayout::positions, take);
  return take;
}

// Mean logarithm of the tempo of all samples.
float tempo_of(const SampleSet& set) {
  float sum = 0;
  for (const Sample& sample : set.samples()) sum += sample.log_rate;
  return sum / static_cast<float>(set.samples().size());
}

TEST(NeutralTempos, a_style_that_only_matches_the_slow_walk_is_measured_against_slow_and_fast) {
  const std::vector<Take> takes = {walk("neutral", 0.7f), walk("neutral", 1.4f),
                                   walk("proud", 0.75f)};
  std::vector<Pairing> pairings = pair_takes(takes, {2}, {0});
  SampleSet set(takes, pairings, {"proud"}, test::kPanache, false);
  EXPECT_NEAR(tempo_of(set), std::log(0.75f / 0.7f), 0.05);
  level_neutral_tempos(takes, pairings, set);
  const double mean = std::sqrt(0.7 * 1.4);
  EXPECT_NEAR(tempo_of(set), std::log(0.75 / mean), 0.08);
  double sum = 0;
  int count = 0;
  for (const Pairing& pairing : pairings) {
    for (const float rate : pairing.rates) sum += std::log(rate), ++count;
  }
  EXPECT_NEAR(sum / count, std::log(0.75 / mean), 0.08);
}

TEST(NeutralTempos, one_neutral_take_changes_nothing) {
  const std::vector<Take> takes = {walk("neutral", 1), walk("proud", 0.8f)};
  std::vector<Pairing> pairings = pair_takes(takes, {1}, {0});
  SampleSet set(takes, pairings, {"proud"}, test::kPanache, false);
  const float before = tempo_of(set);
  level_neutral_tempos(takes, pairings, set);
  EXPECT_EQ(tempo_of(set), before);
}

}  // namespace
}  // namespace panache
