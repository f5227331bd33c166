#include "style/play/pose_predictor.h"

#include <cmath>

#include <gtest/gtest.h>

#include "make_model.h"
#include "style_checks.h"

namespace panache {
namespace {

constexpr double kPoseStep = 1.0 / 60;

std::shared_ptr<const Model> predicting_model(float size) {
  TensorFile file = test::make_model({"old"});
  test::add_predictor(file, size);
  return read(file);
}

// A body whose joints all are at `height` and whose ground is at `distance` along z.
void push(PosePredictor& predictor, double time, float height, float distance) {
  HumanPositions body;
  for (int j = 0; j < kHumanJoints; ++j) body[j] = {0.1f * static_cast<float>(j), height, 0};
  predictor.push(time, body, {{0, 0, distance}, 0});
}

TEST(PosePredictor, constant_velocity_is_continued) {
  PosePredictor predictor(predicting_model(0));
  double time = 0;
  for (int f = 0; f < 240; ++f) {
    time = f * kPoseStep;
    push(predictor, time, 1 + 0.5f * static_cast<float>(time), 2 * static_cast<float>(time));
  }
  for (const double ahead : {0.0, 0.03, 0.1, 0.25}) {
    const auto then = static_cast<float>(time + ahead);
    const PredictedPose body = predictor.predict(ahead);
    EXPECT_NEAR(body.body[3].y, 1 + 0.5f * then, 0.002f) << ahead;
    EXPECT_NEAR(body.root.position.z, 2 * then, 0.005f) << ahead;
    EXPECT_EQ(body.root.facing, 0);
  }
}

TEST(PosePredictor, nothing_ahead_is_now) {
  PosePredictor predictor(predicting_model(0.1f));
  for (int f = 0; f < 60; ++f)
    push(predictor, f * kPoseStep, std::sin(0.1f * static_cast<float>(f)), 0);
  const PredictedPose body = predictor.predict(0);
  EXPECT_EQ(body.body[5].y, std::sin(5.9f));
  EXPECT_EQ(body.root.position, Vec3{});
}

// A network that knows nothing of this motion soon has no say: the error falls to that of the best.
TEST(PosePredictor, who_was_wrong_loses_weight) {
  PosePredictor predictor(predicting_model(2));
  const auto error_at = [&](int from, int frames) {
    float sum = 0;
    for (int f = from; f < from + frames; ++f) {
      const double time = f * kPoseStep;
      const auto height = [](double t) { return 1 + 0.3f * std::sin(3 * static_cast<float>(t)); };
      push(predictor, time, height(time), 0);
      sum += std::abs(predictor.predict(0.1).body[4].y - height(time + 0.1));
    }
    return sum / static_cast<float>(frames);
  };
  const float early = error_at(0, 20);
  error_at(20, 600);
  const float late = error_at(620, 120);
  EXPECT_LT(late, early / 4);
  // Constant acceleration over 0.1 s of this sine: its third derivative, 0.3 * 27 m/s^3, times
  // 0.1 * 0.15 * 0.2 / 6 s^3 is 4 mm at the most.
  EXPECT_LT(late, 0.005f);
}

// A body that bobs in this many frames, of which eight are 0.1 s. The largest error of what is
// predicted for that time in the sixth second.
float error_of_bobbing(int frames, double ahead) {
  constexpr double kEighth = 0.1 / 8 * (1 + 1e-9);  // No earlier than what is checked.
  PosePredictor predictor(predicting_model(0));
  const auto height = [&](int f) {
    const float share = static_cast<float>(f % frames) / static_cast<float>(frames);
    return 1 + 0.05f * std::sin(6.2831853f * share + 0.8f);
  };
  float max = 0;
  for (int f = 0; f < 480; ++f) {
    push(predictor, f * kEighth, height(f), 0);
    const float wanted = height(f + static_cast<int>(std::lround(ahead / kEighth)));
    if (f >= 400) max = std::max(max, std::abs(predictor.predict(ahead).body[4].y - wanted));
  }
  return max;
}

// What comes back in just that time is predicted by no motion at all, which is wrong of others.
TEST(PosePredictor, each_time_ahead_is_predicted_by_who_was_right_that_far_ahead) {
  EXPECT_LT(error_of_bobbing(20, 0.25), 1e-4f);
  EXPECT_GT(error_of_bobbing(20, 0.1), 0.05f);
  EXPECT_LT(error_of_bobbing(8, 0.1), 1e-4f);
  EXPECT_GT(error_of_bobbing(8, 0.25), 0.05f);
}

TEST(PosePredictor, any_times_and_numbers_leave_it_finite) {
  PosePredictor predictor(predicting_model(0.2f));
  Random random(3);
  double time = 0;
  for (int f = 0; f < 3000; ++f) {
    time += f % 50 == 0 ? 0.4 : 0.03 * random.uniform();
    push(predictor, time, 2 * random.normal(), 100 * random.normal());
    const PredictedPose body = predictor.predict(0.25);
    ASSERT_TRUE(is_finite(body.body[7])) << f;
    ASSERT_TRUE(is_finite(body.root.position)) << f;
  }
}

TEST(PredictorNetwork, a_file_that_lacks_a_part_is_rejected_with_a_message) {
  const auto rejection = [](const char* key, Tensor tensor) {
    TensorFile file = test::make_model({"old"});
    test::add_predictor(file);
    if (tensor.values.empty()) {
      file.tensors.erase(key);
    } else {
      file.tensors[key] = std::move(tensor);
    }
    return failure(file);
  };
  EXPECT_EQ(rejection("predict.mean", {}), "m.safetensors: tensor 'predict.mean' is missing");
  EXPECT_EQ(rejection("predict.linear", test::constant_tensor(5, 0)),
            "m.safetensors: tensor 'predict.linear' has shape [5]; expected [330]");
  EXPECT_EQ(rejection("predict.scale", test::constant_tensor(66, 0)),
            "m.safetensors: tensor 'predict.scale' must be above zero throughout");
  EXPECT_EQ(rejection("predict.head.0.bias", test::constant_tensor(7, 0)),
            "m.safetensors: tensor 'predict.head.0.bias' has shape [7]; expected [66]");
  EXPECT_EQ(rejection("predict.trunk.0.weight", {}),
            "m.safetensors: tensor 'predict.trunk.0.weight' is missing");
}

}  // namespace
}  // namespace panache
