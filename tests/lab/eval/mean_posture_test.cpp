#include "eval/systems/mean_posture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "known_recipes.h"
#include "learn/make_takes.h"
#include "learn/samples.h"
#include "takes/manifest.h"

namespace panache {
namespace {

Take take_of(const std::string& style, const std::string& content, float rate, float lean) {
  Take take = test::make_take(style, style == "neutral" ? 240 : 110, 0.3f, rate, lean);
  take.row.content = content;
  return take;
}

// A neutral walk and wave; old ones that lean by 0.4 in the walk and by 0.8 in the wave, which is
// 1.25 times as fast; and a sad walk.
struct TestData {
  std::vector<Take> takes;
  std::vector<Pairing> pairings;
};
TestData made_data(float wave_lean = 0.8f) {
  TestData data;
  data.takes = {take_of("neutral", "walk", 1, 0), take_of("neutral", "wave", 1, 0),
                take_of("old", "walk", 1, 0.4f), take_of("old", "wave", 1.25f, wave_lean),
                take_of("sad", "walk", 1, -0.3f)};
  data.pairings = pair_takes(data.takes, {2, 3, 4}, {0, 1});
  return data;
}
const std::vector<StyleName> kStyles = {{"old", {"old"}, "bent"}, {"sad", {"sad"}, ""}};

// The mean posture, without the pairs of a content.
MeanPosture mean_posture(TestData data, const std::string& left_out = "") {
  std::erase_if(data.pairings, [&](const Pairing& pairing) {
    return data.takes[pairing.styled].row.content == left_out;
  });
  return {"mean", {data.takes, data.pairings, kStyles}};
}

struct Answer {
  std::array<float, StyleDelta::kSize> change;
  float log_rate;
};
// To a strength of each style and a random window.
Answer answer(const MeanPosture& system, std::array<float, 2> strengths, uint64_t seed = 1) {
  std::vector<float> window(size_t(kWindowPoses) * pose_feature_count(PoseLayout::positions));
  Random random(seed);
  for (float& w : window) w = random.normal();
  const auto source = system.make_source({}, 0, {{0, strengths[0]}, {1, strengths[1]}});
  const AskedChange asked = source->ask({window, nullptr, {}});
  for (const float planted : asked.contacts) EXPECT_EQ(planted, 0);
  Answer out{{}, asked.log_rate};
  pack(asked.delta, out.change);
  return out;
}

// The mean that it should answer with, over the samples of a style and content; "" for any.
Answer expected(const TestData& data, int style, const std::string& content) {
  const SampleSet set(data.takes, data.pairings, {"old", "sad"}, test::kPanache, false);
  std::array<double, StyleDelta::kSize> sum{};
  double rate = 0, count = 0;
  for (size_t i = 0; i < set.samples().size(); ++i) {
    const Sample& sample = set.samples()[i];
    if (sample.style != style || (!content.empty() && set.content(sample) != content)) continue;
    for (int n = 0; n < StyleDelta::kSize; ++n) sum[n] += set.target(i)[n];
    rate += sample.log_rate;
    ++count;
  }
  Answer mean{{}, static_cast<float>(rate / count)};
  for (int n = 0; n < StyleDelta::kSize; ++n) mean.change[n] = static_cast<float>(sum[n] / count);
  return mean;
}

void expect_same(const Answer& a, const Answer& b) {
  // Means of some hundred numbers below 1, rounded to single precision.
  for (int n = 0; n < StyleDelta::kSize; ++n) EXPECT_NEAR(a.change[n], b.change[n], 1e-5) << n;
  EXPECT_NEAR(a.log_rate, b.log_rate, 1e-5);
}

TEST(MeanPosture,
     answers_with_the_mean_change_of_the_style_whatever_the_window_and_plants_no_foot) {
  const TestData data = made_data();
  const MeanPosture system = mean_posture(data);
  for (const uint64_t seed : {1, 2}) {
    expect_same(answer(system, {1, 0}, seed), expected(data, 0, ""));
    expect_same(answer(system, {0, 1}, seed), expected(data, 1, ""));
  }
  // Joint 2 leans by 0.4 in about half of the pairs and by 0.8 in the others, about x.
  EXPECT_NEAR(answer(system, {1, 0}).change[6], 0.6, 0.1);
  EXPECT_NEAR(answer(system, {0, 1}).change[6], -0.3, 0.02);
  EXPECT_NEAR(answer(system, {1, 0}).log_rate, std::log(1.25) / 2, 0.06);
}

TEST(MeanPosture, half_a_style_is_half_its_posture_and_none_is_none) {
  const MeanPosture system = mean_posture(made_data());
  const Answer whole = answer(system, {1, 0}), half = answer(system, {0.5f, 0});
  EXPECT_NEAR(half.change[6], 0.5f * whole.change[6], 1e-6);
  for (const float none : answer(system, {0, 0}).change) EXPECT_EQ(none, 0);
}

TEST(MeanPosture, contents_that_are_left_out_have_no_influence) {
  const TestData data = made_data(0.8f), other = made_data(-0.5f);
  const Answer without = answer(mean_posture(data, "wave"), {1, 0});
  expect_same(without, expected(data, 0, "walk"));
  EXPECT_EQ(without.change, answer(mean_posture(other, "wave"), {1, 0}).change);
  EXPECT_NE(answer(mean_posture(data), {1, 0}).change, answer(mean_posture(other), {1, 0}).change);
}

TEST(MeanPosture, at_strength_2_it_holds_twice_as_much_as_any_style) {
  const MeanPosture system = mean_posture(made_data());
  EXPECT_NEAR(answer(system, {2, 0}).change[6], 2 * answer(system, {1, 0}).change[6], 1e-5);
}

TEST(MeanPosture, is_a_system_of_the_styles_with_a_number_for_each_part_of_a_change) {
  const TestData data = made_data();
  const auto system = make_mean_posture("mean", {data.takes, data.pairings, kStyles});
  ASSERT_TRUE(system.ok());
  EXPECT_EQ((*system)->name(), "mean");
  EXPECT_EQ((*system)->styles(), (std::vector<std::string>{"old", "sad"}));
  EXPECT_EQ((*system)->facts().parameters, 2u * (StyleDelta::kSize + 1));
  EXPECT_EQ((*system)->model(), nullptr);
}

}  // namespace
}  // namespace panache
