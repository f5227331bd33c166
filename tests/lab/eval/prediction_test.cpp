#include "eval/prediction.h"

#include <gtest/gtest.h>

#include "learn/make_takes.h"
#include "make_model.h"

namespace panache {
namespace {

std::shared_ptr<const Model> predicting_model() {
  TensorFile file = test::make_model({"old"});
  test::add_predictor(file);
  return *Model::parse(format_safetensors(file), "test model");
}

// A body that is carried along z at `speed` m/s and keeps its pose.
Take carried(float speed) {
  Take take = test::make_take("neutral", 90, 0, 0, 0);
  for (int f = 0; f < take.frames(); ++f) {
    take.root[f].position = {0, 0, speed * static_cast<float>(f / kTakeRate)};
  }
  return take;
}

// Where the way is straight, holding is off by the way, and constant velocity by nothing.
TEST(PosePredictor, is_off_by_what_it_is_off) {
  const Take take = carried(2);
  const auto rows = measure_prediction(predicting_model(), {&take});
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_EQ(rows[0].content, "walk");
  EXPECT_EQ(rows[0].instants, 20u);  // Every third of the 60 frames from 15 to 74.
  for (size_t h = 0; h < kPredictionSeconds.size(); ++h) {
    // Centimetres; 1e-3 of them is the rounding of floats of a few metres.
    EXPECT_NEAR(rows[0].held_cm[h], 200 * kPredictionSeconds[h], 1e-3);
    EXPECT_NEAR(rows[0].velocity_cm[h], 0, 1e-3);
    // Before it has learnt whom to trust, holding has a hundredth or two of the say.
    EXPECT_LT(rows[0].predicted_cm[h], 0.03 * rows[0].held_cm[h]);
  }
}

TEST(PosePredictor, takes_are_gathered_by_content_and_short_ones_left_out) {
  Take walk = carried(1), other = carried(1), run = carried(3), shred = carried(9);
  run.row.content = "run";
  shred.row.content = "shred";
  shred.body.resize(20);
  const auto rows = measure_prediction(predicting_model(), {&walk, &run, &other, &shred});
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0].content, "run");
  EXPECT_EQ(rows[1].content, "walk");
  EXPECT_EQ(rows[1].instants, 2 * rows[0].instants);
  EXPECT_NEAR(rows[1].held_cm[1], 10, 1e-3);
}

}  // namespace
}  // namespace panache
