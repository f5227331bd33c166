#include "eval/systems/mean_posture.h"

#include <cmath>

#include <gtest/gtest.h>

#include "known_recipes.h"
#include "learn/make_takes.h"
#include "learn/samples.h"

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

// A model without networks that answers as the mean posture does, without the pairs of a content.
std::shared_ptr<const Model> mean_posture_model(TestData data, const std::string& left_out = "") {
  std::erase_if(data.pairings, [&](const Pairing& pairing) {
    return data.takes[pairing.styled].row.content == left_out;
  });
  return Model::of_constants(mean_changes({data.takes, data.pairings, kStyles}));
}

struct Answer {
  std::vector<float> pose;
  float log_rate;
};
Answer answer(const std::shared_ptr<const Model>& model, std::vector<float> strengths,
              uint64_t seed = 1) {
  StyleNetworks networks(model);
  std::vector<float> window(size_t(kWindowPoses) * pose_feature_count(PoseLayout::positions));
  Random random(seed);
  for (float& w : window) w = random.normal();
  networks.set_strengths(strengths);
  networks.forward(window);
  return {{networks.pose().begin(), networks.pose().end()}, networks.log_rate()};
}

// The mean that the model should answer with, over the samples of a style and content; "" for any.
Answer expected(const TestData& data, int style, const std::string& content) {
  const SampleSet set(data.takes, data.pairings, {"old", "sad"}, test::kPanache, false);
  std::vector<double> sum(StyleDelta::kSize);
  double rate = 0, count = 0;
  for (size_t i = 0; i < set.samples().size(); ++i) {
    const Sample& sample = set.samples()[i];
    if (sample.style != style || (!content.empty() && set.content(sample) != content)) continue;
    for (int n = 0; n < StyleDelta::kSize; ++n) sum[n] += set.target(i)[n];
    rate += sample.log_rate;
    ++count;
  }
  Answer mean{{}, static_cast<float>(rate / count)};
  for (const double s : sum) mean.pose.push_back(static_cast<float>(s / count));
  return mean;
}

void expect_same(const Answer& a, const Answer& b) {
  // Means of some hundred numbers below 1, rounded to single precision.
  for (int n = 0; n < StyleDelta::kSize; ++n) EXPECT_NEAR(a.pose[n], b.pose[n], 1e-5) << n;
  EXPECT_NEAR(a.log_rate, b.log_rate, 1e-5);
}

TEST(MeanPosture, answers_with_the_mean_change_of_the_style_whatever_the_window) {
  const TestData data = made_data();
  const auto model = mean_posture_model(data);
  EXPECT_EQ(&model->recipe(), &test::kPanache);
  EXPECT_EQ(model->styles()[0].description, "bent");
  for (const uint64_t seed : {1, 2}) {
    expect_same(answer(model, {1, 0}, seed), expected(data, 0, ""));
    expect_same(answer(model, {0, 1}, seed), expected(data, 1, ""));
  }
  // Joint 2 leans by 0.4 in about half of the pairs and by 0.8 in the others, about x.
  EXPECT_NEAR(answer(model, {1, 0}).pose[6], 0.6, 0.1);
  EXPECT_NEAR(answer(model, {0, 1}).pose[6], -0.3, 0.02);
  EXPECT_NEAR(answer(model, {1, 0}).log_rate, std::log(1.25) / 2, 0.06);
}

TEST(MeanPosture, half_a_style_is_half_its_posture_and_none_is_none) {
  const auto model = mean_posture_model(made_data());
  const Answer whole = answer(model, {1, 0}), half = answer(model, {0.5f, 0});
  EXPECT_NEAR(half.pose[6], 0.5f * whole.pose[6], 1e-6);
  for (const float none : answer(model, {0, 0}).pose) EXPECT_EQ(none, 0);
}

TEST(MeanPosture, contents_that_are_left_out_have_no_influence) {
  const TestData data = made_data(0.8f), other = made_data(-0.5f);
  const Answer without = answer(mean_posture_model(data, "wave"), {1, 0});
  expect_same(without, expected(data, 0, "walk"));
  EXPECT_EQ(without.pose, answer(mean_posture_model(other, "wave"), {1, 0}).pose);
  EXPECT_NE(answer(mean_posture_model(data), {1, 0}).pose,
            answer(mean_posture_model(other), {1, 0}).pose);
}

TEST(MeanPosture, no_foot_is_ever_planted) {
  const auto model = mean_posture_model(made_data());
  StyleNetworks networks(model);
  networks.set_strengths(std::vector<float>{1, 0});
  networks.forward(std::vector<float>(size_t(kWindowPoses) * 66, 0.5f));
  for (const float planted : networks.contact()) EXPECT_LT(planted, 1e-6f);
}

TEST(MeanPosture, at_strength_2_it_holds_twice_as_much_as_any_style) {
  const auto model = mean_posture_model(made_data());
  EXPECT_NEAR(answer(model, {2, 0}).pose[6], 2 * answer(model, {1, 0}).pose[6], 1e-5);
}

TEST(MeanPosture, is_a_system_of_the_styles_with_a_number_for_each_part_of_a_change) {
  const TestData data = made_data();
  const auto system = make_mean_posture("mean", {data.takes, data.pairings, kStyles});
  ASSERT_TRUE(system.ok());
  EXPECT_EQ((*system)->name(), "mean");
  EXPECT_EQ((*system)->styles(), (std::vector<std::string>{"old", "sad"}));
  EXPECT_EQ((*system)->facts().parameters, 2u * (StyleDelta::kSize + 1));
  EXPECT_EQ((*system)->predicting_model(), nullptr);
}

}  // namespace
}  // namespace panache
