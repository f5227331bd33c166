#include "train/train_predictor.h"

#include <cmath>

#include <gtest/gtest.h>

#include "learn/make_takes.h"
#include "make_model.h"
#include "style/model/predictor_network.h"

namespace panache {
namespace {

std::vector<Take> walks() {
  std::vector<Take> takes;
  for (int i = 0; i < 6; ++i) {
    takes.push_back(
        test::make_take("neutral", 90, static_cast<float>(i), 1 + 0.1f * static_cast<float>(i), 0));
  }
  return takes;
}

TEST(TrainPredictor, learns_to_beat_constant_velocity_and_is_read_back) {
  TensorFile file = test::make_model({"old"});
  std::vector<LossPoint> losses;
  double last = 0;
  train_predictor(
      walks(), 200, 1, [&](double share) { last = share; }, file, losses);
  EXPECT_EQ(last, 1);
  ASSERT_EQ(losses.size(), 50u);
  EXPECT_EQ(losses.front().network, "predict");
  // The loss is the error as a share of the better of holding and constant velocity.
  EXPECT_LT(losses.back().train, 0.8f);
  EXPECT_TRUE(std::isnan(losses.back().validation));  // No take is held back.
  EXPECT_LT(losses.back().train, losses.front().train);
  const auto model = Model::parse(format_safetensors(file), "model");
  ASSERT_TRUE(model.ok()) << model.error().message;
  EXPECT_NE((*model)->predictor(), nullptr);
}

TEST(TrainPredictor, the_same_seed_gives_the_same_bytes) {
  const auto bytes = [](uint64_t seed) {
    TensorFile file;
    std::vector<LossPoint> losses;
    train_predictor(walks(), 5, seed, {}, file, losses);
    return format_safetensors(file);
  };
  EXPECT_EQ(bytes(1), bytes(1));
  EXPECT_NE(bytes(1), bytes(2));
}

TEST(TrainPredictor, takes_too_short_to_learn_from_add_nothing) {
  std::vector<Take> takes = walks();
  for (Take& take : takes) {
    take.body.resize(12);
    take.root.resize(12);
  }
  TensorFile file;
  std::vector<LossPoint> losses;
  train_predictor(takes, 5, 1, {}, file, losses);
  EXPECT_TRUE(file.tensors.empty());
}

}  // namespace
}  // namespace panache
