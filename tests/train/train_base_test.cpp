#include "train/train_base.h"

#include <gtest/gtest.h>

#include "known_recipes.h"
#include "learn/learn_style.h"
#include "learn/make_walks.h"
#include "learn/style_file.h"
#include "make_styled_takes.h"
#include "net/quantize.h"
#include "style/model.h"
#include "train/matrix_products.h"

namespace panache {
namespace {

TrainOptions few_steps() {
  TrainOptions options(test::kPanache);
  options.settings.base_steps = 150;
  options.settings.predictor_steps = 20;
  return options;
}

// Takes that say to be of a style: a base does not look at it.
const Trained& trained() {
  static const Trained base = [] {
    EXPECT_TRUE(prepare_matrix_products().ok());
    return *train_base(test::styled_takes({"neutral", "old"}, {0, 1}), few_steps());
  }();
  return base;
}

std::shared_ptr<const Model> parse(const TensorFile& file) {
  const auto model = Model::parse(format_safetensors(file), "base.safetensors");
  EXPECT_TRUE(model.ok()) << model.error().message;
  return *model;
}

TEST(TrainBase, makes_a_model_without_styles_that_can_learn) {
  const auto model = parse(trained().model);
  EXPECT_TRUE(model->styles().empty());
  EXPECT_TRUE(model->can_learn());
  EXPECT_NE(model->predictor(), nullptr);
  EXPECT_EQ(model->find_style("old").error().message,
            "unknown style 'old'; the model has no styles yet");
  EXPECT_FALSE(trained().model.tensors.contains("pose.head.0.weight"));
  EXPECT_FALSE(trained().model.tensors.contains("timing.trunk.0.weight"));
  StyleNetworks networks(model);
  const std::vector<float> window(size_t(kWindowPoses) * pose_feature_count(model->layout()), 0.3f);
  networks.forward(window);
  for (const float number : networks.pose()) EXPECT_EQ(number, 0);
  EXPECT_EQ(networks.log_rate(), 0);
  EXPECT_EQ(networks.gate(), 1);
}

TEST(TrainBase, what_it_must_tell_is_told_better_and_better) {
  std::vector<float> pose, contact;
  for (const LossPoint& point : trained().losses) {
    if (point.network == "pose") pose.push_back(point.train);
    if (point.network == "contact") contact.push_back(point.train);
  }
  ASSERT_EQ(pose.size(), 50u);
  EXPECT_LT(pose.back(), 0.5f * pose.front());
  EXPECT_LT(contact.back(), 0.9f * contact.front());
}

TEST(TrainBase, gives_the_same_bytes_again_and_others_for_another_seed) {
  const auto bytes = [](uint64_t seed) {
    TrainOptions options = few_steps();
    options.settings.base_steps = 10;
    options.seed = seed;
    return format_safetensors(train_base(test::styled_takes({"neutral"}, {0}), options)->model);
  };
  EXPECT_EQ(bytes(1), bytes(1));
  EXPECT_NE(bytes(1), bytes(2));
}

TEST(TrainBase, a_style_learnt_on_it_is_the_style_in_int8_too) {
  const LearnPair pair = test::make_pair(test::neutral_walk(), test::bent_walk());
  for (const TensorFile& base : {trained().model, quantize(trained().model)}) {
    const LearntStyle learnt = learn_style(base, "base", std::span(&pair, 1), "bent", "").value();
    EXPECT_LT(learnt.held_back_cm, 0.25 * learnt.untouched_cm);
    const TensorFile with_it = add_style(base, "base", learnt.file, "style", false).value();
    EXPECT_EQ(parse(with_it)->styles().size(), 1u);
  }
}

TEST(TrainBase, motion_that_is_none_is_rejected) {
  EXPECT_TRUE(prepare_matrix_products().ok());
  const auto failed = train_base(test::styled_takes({"neutral"}, {0}, 2), few_steps());
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().message,
            "there is no motion to train a base on; expected a take of several frames");
}

}  // namespace
}  // namespace panache
