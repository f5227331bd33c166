#include "train/training_data.h"

#include <cstdlib>
#include <map>

#include <gtest/gtest.h>

#include "known_recipes.h"
#include "make_styled_takes.h"
#include "style/stages/shaping.h"
#include "takes/load_takes.h"
#include "takes/manifest.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr const char* kManifest = "takes.csv";

// A walk whose back leans by this much, radians.
Take leaning_walk(const std::string& style, const std::string& person, int set, float lean) {
  Take take = test::styled_take("neutral", "walk", 0, 90);
  take.row.style = style;
  take.row.neutral = style == "neutral";
  take.row.manifest = kManifest;
  take.row.person = person;
  take.row.set = set;
  StyleDelta change;
  change.rotations[index(spine)] = {lean, 0, 0};
  for (int f = 0; f < take.frames(); ++f) {
    take.body[f] = change_body(take.body[f], change);
    take.rotations[f][index(spine)] =
        exp_rotation(change.rotations[index(spine)]) * take.rotations[f][index(spine)];
  }
  write_numbers(PoseLayout::positions, take);
  return take;
}

SampleSet sample_set(const std::vector<Take>& takes, const std::vector<std::string>& styles) {
  std::vector<int> styled, neutral;
  for (size_t t = 0; t < takes.size(); ++t) {
    (takes[t].row.neutral ? neutral : styled).push_back(static_cast<int>(t));
  }
  return {takes, pair_takes(takes, styled, neutral), styles, test::kPanache, false};
}

// How far the back of a style leans in the mean of its samples.
float lean_of(const SampleSet& set, int style) {
  float sum = 0, count = 0;
  for (size_t i = 0; i < set.samples().size(); ++i) {
    if (set.samples()[i].style != style) continue;
    sum += unpack(set.target(i).first<StyleDelta::kSize>()).rotations[index(spine)].x;
    ++count;
  }
  EXPECT_GT(count, 0);
  return sum / count;
}

// Three performers with a neutral take, who lean by 0 and 0.2 to both sides, and a fourth without,
// whose leaning of 0.3 all his styles share.
std::vector<Take> four_performers(int with_neutral) {
  std::vector<Take> takes;
  const float habits[] = {0, 0.2f, -0.2f};
  for (int p = 0; p < with_neutral; ++p) {
    const std::string person(1, static_cast<char>('a' + p));
    takes.push_back(leaning_walk("neutral", person, p, habits[p]));
    takes.push_back(leaning_walk("bent", person, p, habits[p] + 0.05f));
  }
  takes.push_back(leaning_walk("one", "d", 3, 0.3f - 0.05f));
  takes.push_back(leaning_walk("two", "d", 3, 0.3f));
  takes.push_back(leaning_walk("three", "d", 3, 0.3f + 0.05f));
  return takes;
}

const std::vector<std::string> kStyles = {"bent", "one", "two", "three"};

TEST(Performers, what_all_styles_of_one_without_a_neutral_take_share_is_taken_off) {
  const std::vector<Take> takes = four_performers(3);
  SampleSet set = sample_set(takes, kStyles);
  const float bent = lean_of(set, 0), one = lean_of(set, 1), three = lean_of(set, 3);
  take_off_performers(takes, set);
  EXPECT_EQ(lean_of(set, 0), bent);  // His own neutral take says what he is like.
  const float taken_off = one - lean_of(set, 1);
  EXPECT_GT(taken_off, 0.15f);
  EXPECT_LT(taken_off, 0.35f);
  EXPECT_NEAR(lean_of(set, 3) - lean_of(set, 1), three - one, 2e-3f);  // What tells them apart.
}

TEST(Performers, two_others_do_not_say_how_much_persons_differ) {
  const std::vector<Take> takes = four_performers(2);
  SampleSet set = sample_set(takes, kStyles);
  const float one = lean_of(set, 1);
  take_off_performers(takes, set);
  EXPECT_EQ(lean_of(set, 1), one);
}

// Real performers whose neutral walks are hidden: what is then learnt of their styles against what
// their own neutral walks say.
TEST(PerformersReal, hidden_neutral_takes_are_made_up_for_in_part) {
  const char* data = std::getenv("PANACHE_DATA");
  if (!data) GTEST_SKIP() << "PANACHE_DATA is not set";
  const auto rows = read_manifest(std::string(data) + "/cmu-styles.csv", 0);
  if (!rows.ok()) GTEST_SKIP() << rows.error().message;
  std::vector<ManifestRow> walks;
  for (const ManifestRow& row : *rows) {
    if (row.content == "walk" && !row.test) walks.push_back(row);
  }
  auto names = std::vector<StyleName>();
  ASSERT_TRUE(apply_style_names(names, walks).ok());
  std::vector<std::string> styles;
  for (const StyleName& style : names) styles.push_back(style.name);
  auto takes = load_takes(walks, PoseLayout::positions);
  ASSERT_TRUE(takes.ok()) << takes.error().message;

  using Poses = std::map<int, HumanPositions>;  // Of a style.
  const HumanPositions body = (*takes)[0].body[30];
  const auto poses = [&](const SampleSet& set, int performer) {
    std::map<int, std::array<float, StyleDelta::kSize>> sums;
    std::map<int, float> counts;
    for (size_t i = 0; i < set.samples().size(); ++i) {
      const Sample& sample = set.samples()[i];
      if ((*takes)[sample.styled].row.set != performer) continue;
      for (int n = 0; n < StyleDelta::kSize; ++n) sums[sample.style][n] += set.target(i)[n];
      ++counts[sample.style];
    }
    Poses means;
    for (auto& [style, sum] : sums) {
      for (float& number : sum) number /= counts[style];
      means[style] = change_body(body, unpack(sum));
    }
    return means;
  };
  const auto error = [](const Poses& one, const Poses& other) {
    double sum = 0;
    for (const auto& [style, pose] : one) {
      for (int j = 0; j < kHumanJoints; ++j) sum += length(pose[j] - other.at(style)[j]);
    }
    return 100 * sum / static_cast<double>(one.size() * kHumanJoints);  // cm.
  };
  const SampleSet own = sample_set(*takes, styles);
  double before = 0, after = 0;
  for (const char* person : {"91", "104"}) {
    int performer = -1;
    std::vector<Take> hidden;
    for (const Take& take : *takes) {
      if (take.row.person == person) performer = take.row.set;
      if (take.row.person != person || !take.row.neutral) hidden.push_back(take);
    }
    const Poses truth = poses(own, performer);
    std::swap(*takes, hidden);
    SampleSet set = sample_set(*takes, styles);
    const double raw = error(truth, poses(set, performer));
    take_off_performers(*takes, set);
    const double left = error(truth, poses(set, performer));
    std::swap(*takes, hidden);
    std::printf("%s: %.2f cm off, %.2f with the others' neutral walks as they are\n", person, left,
                raw);
    before += raw;
    after += left;
  }
  EXPECT_LT(after, 0.9 * before);
}

}  // namespace
}  // namespace panache
