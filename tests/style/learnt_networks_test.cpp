// Learnt styles: heads on the activations of all layers, each with a gate of its own.

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "make_model.h"
#include "style/networks/networks.h"
#include "style_checks.h"

namespace panache {
namespace {

// One built-in style and a learnt one whose gate is open at `rest` = 0.
TensorFile with_learnt(float rest = 0) {
  TensorFile file = test::make_model({"old"});
  test::add_learnt(file, 0, "drunk", "a test");
  for (float& w : file.tensors["learnt.0.gate.worth"].values) w = 0;
  file.tensors["learnt.0.gate.rest"].values = {rest};
  return file;
}

struct Answer {
  std::vector<float> pose;
  float log_rate, left, right, gate;
};
Answer answer(StyleNetworks& networks, const std::vector<float>& window,
              const std::vector<float>& strengths) {
  networks.set_strengths(strengths);
  networks.forward(window);
  return {{networks.pose().begin(), networks.pose().end()},
          networks.log_rate(),
          networks.contact()[0],
          networks.contact()[1],
          networks.gate()};
}

// What head 0 answers to these activations. [kLearntOutputs]
std::vector<double> head(const TensorFile& file, const std::vector<float>& activations) {
  const std::vector<float>& bias = file.tensors.at("learnt.0.head.bias").values;
  const std::vector<float>& weights = file.tensors.at("learnt.0.head.weight").values;
  std::vector<double> out(bias.begin(), bias.end());
  for (size_t i = 0; i < weights.size(); ++i) {
    out[i % out.size()] += double(activations[i / out.size()]) * double(weights[i]);
  }
  return out;
}

double logit(double p) { return std::log(p / (1 - p)); }

// Sums of 32 activations of about 1 and weights of about 0.1, in single precision.
constexpr double kRounding = 1e-5;

TEST(LearntNetworks, the_head_answers_to_the_features_of_all_layers) {
  const TensorFile file = with_learnt();
  const auto model = read(file);
  EXPECT_TRUE(model->can_learn());
  EXPECT_FALSE(model->styles()[0].learnt);
  EXPECT_TRUE(model->styles()[1].learnt);
  EXPECT_EQ(model->styles()[1].origin, "a test");
  StyleNetworks networks(model);
  const std::vector<float> window = window_of(1, 1);
  std::vector<float> activations(model->activation_count());
  ASSERT_EQ(activations.size(), 32u);  // Two layers of 16.
  networks.activations(window, activations);
  const std::vector<double> expected = head(file, activations);
  const Answer none = answer(networks, window, {0, 0}), got = answer(networks, window, {0, 0.5f});
  for (int i = 0; i < StyleDelta::kSize; ++i) {
    EXPECT_EQ(none.pose[i], 0);
    const double scale = static_cast<double>(model->output_scale()[i]);
    EXPECT_NEAR(got.pose[i], 0.5 * expected[i] * scale, kRounding) << i;
  }
  EXPECT_NEAR(got.log_rate, 0.5 * expected[StyleDelta::kSize], kRounding);
  EXPECT_NEAR(logit(got.left) - logit(none.left), 0.5 * expected[StyleDelta::kSize + 1], 1e-4);
  EXPECT_NEAR(logit(got.right) - logit(none.right), 0.5 * expected[StyleDelta::kSize + 2], 1e-4);
  EXPECT_EQ(got.gate, 1);
}

TEST(LearntNetworks, features_are_those_of_the_layers_one_after_another) {
  const TensorFile file = with_learnt();
  const auto model = read(file);
  const StyleNetworks networks(model);
  const std::vector<float> window = window_of(1, 2);
  std::vector<float> activations(model->activation_count());
  networks.activations(window, activations);
  // The second layer by hand, from the first.
  const std::vector<float>& weights = file.tensors.at("pose.trunk.1.weight").values;
  const std::vector<float>& bias = file.tensors.at("pose.trunk.1.bias").values;
  for (size_t o = 0; o < 16; ++o) {
    double sum = bias[o];
    for (size_t i = 0; i < 16; ++i) sum += double(activations[i]) * double(weights[i * 16 + o]);
    EXPECT_NEAR(activations[16 + o], sum > 0 ? sum : std::expm1(sum), 1e-5) << o;
  }
}

TEST(LearntNetworks, styles_add_up_and_are_exaggerated_like_others) {
  const auto model = read(with_learnt());
  StyleNetworks networks(model);
  const std::vector<float> window = window_of(1, 1);
  const Answer old = answer(networks, window, {1, 0}), drunk = answer(networks, window, {0, 1});
  const Answer both = answer(networks, window, {0.3f, 0.6f});
  const Answer two_old = answer(networks, window, {2, 0}), two = answer(networks, window, {0, 2});
  const double share = two_old.pose[0] / old.pose[0];
  for (int i = 0; i < StyleDelta::kSize; ++i) {
    EXPECT_NEAR(both.pose[i], 0.3 * old.pose[i] + 0.6 * drunk.pose[i], kRounding);
    EXPECT_NEAR(two.pose[i], share * drunk.pose[i], kRounding);
  }
}

TEST(LearntNetworks, beyond_its_gate_a_style_is_drawn_to_its_mean_answer) {
  const TensorFile open_file = with_learnt();
  StyleNetworks open(read(open_file));
  const std::vector<float> window = window_of(1, 1);
  const std::vector<double> mean = head(open_file, open_file.tensors.at("learnt.0.mean").values);
  const Answer whole = answer(open, window, {0, 1});
  const float scale = open.model().output_scale()[0];

  // The leverage: rest times the square of the standardised distance.
  std::vector<float> activations(open.model().activation_count());
  open.activations(window, activations);
  double square = 0;
  for (size_t f = 0; f < activations.size(); ++f) {
    square += std::pow(activations[f] - open_file.tensors.at("learnt.0.mean").values[f], 2);
  }
  StyleNetworks int8(read(with_learnt(static_cast<float>(2 / square))));
  const Answer drawn = answer(int8, window, {0, 1});
  EXPECT_NEAR(drawn.gate, 0.5, 1e-5);
  EXPECT_NEAR(drawn.pose[0], 0.5 * whole.pose[0] + 0.5 * mean[0] * scale, kRounding);
  StyleNetworks closed(read(with_learnt(1e9f)));
  const Answer posture = answer(closed, window, {0, 1});
  EXPECT_NEAR(posture.pose[0], mean[0] * scale, kRounding);
  EXPECT_NEAR(posture.log_rate, mean[StyleDelta::kSize], kRounding);
  // Along a main direction a square is worth more or less than elsewhere.
  TensorFile directed = with_learnt();
  directed.tensors["learnt.0.gate.worth"].values[3] = 1e9f;
  StyleNetworks far(read(directed));
  EXPECT_LT(answer(far, window, {0, 1}).gate, 1e-3f);
}

TEST(LearntNetworks, the_gate_is_the_mean_of_those_in_force_and_moves_by_its_share) {
  TensorFile file = with_learnt(1e9f);
  test::add_gate(file, 1e9f);  // The built-in style knows everything.
  StyleNetworks networks(read(file));
  const std::vector<float> window = window_of(1, 1);
  EXPECT_NEAR(answer(networks, window, {0.75f, 0.25f}).gate, 0.75, 1e-4);
  EXPECT_EQ(answer(networks, window, {1, 0}).gate, 1);
  StyleNetworks eased(read(file));
  eased.set_strengths(std::array{0.0f, 1.0f});
  eased.forward(window, 0.25f);
  EXPECT_NEAR(eased.gate(), 0.75, 1e-4);
  eased.forward(window, 0.25f);
  EXPECT_NEAR(eased.gate(), 0.75 * 0.75, 1e-4);
}

TEST(LearntNetworks, a_model_may_have_learnt_styles_only) {
  TensorFile file = with_learnt();
  file.metadata["styles"] = "drunk\n";
  for (const char* key : {"pose.head.0", "timing.head.0", "contact.head.1"}) {
    for (const char* part : {".weight", ".bias"}) file.tensors.erase(std::string(key) + part);
  }
  StyleNetworks only(read(file)), both(read(with_learnt()));
  const std::vector<float> window = window_of(1, 1);
  EXPECT_EQ(answer(only, window, {1}).pose, answer(both, window, {0, 1}).pose);
  EXPECT_EQ(answer(only, window, {1}).left, answer(both, window, {0, 1}).left);
}

TEST(LearntNetworks, damaged_ones_are_rejected) {
  const auto message = [](auto&& damage) {
    TensorFile file = with_learnt();
    damage(file);
    return failure(file);
  };
  for (const char* part :
       {"learn.mean", "learn.scale", "learnt.0.head.bias", "learnt.0.mean", "learnt.0.gate.weight",
        "learnt.0.gate.bias", "learnt.0.gate.worth", "learnt.0.gate.rest"}) {
    EXPECT_EQ(message([&](TensorFile& file) { file.tensors.erase(part); }),
              "m.safetensors: tensor '" + std::string(part) + "' is missing");
  }
  EXPECT_EQ(message([](TensorFile& file) {
              file.tensors.erase("learn.mean");
              file.tensors.erase("learn.scale");
            }),
            "m.safetensors: has tensors 'learnt.0.*' of a learnt style, but no 'learn.mean' and "
            "'learn.scale'");
  EXPECT_EQ(message([](TensorFile& file) { file.tensors["learn.scale"].values[3] = 0; }),
            "m.safetensors: tensor 'learn.scale' must be above zero throughout");
  EXPECT_EQ(message([](TensorFile& file) {
              file.tensors["learnt.0.head.weight"].shape = {31, kLearntOutputs};
              file.tensors["learnt.0.head.weight"].values.resize(size_t{31} * kLearntOutputs);
            }),
            "m.safetensors: tensor 'learnt.0.head.weight' has shape [31, 70]; expected [32, 70]");
  EXPECT_NE(message([](TensorFile& file) { file.metadata["styles"] = ""; }), "");
  EXPECT_EQ(message([](TensorFile& file) {
              test::add_learnt(file, 1, "x", "");
              file.metadata["styles"] = "drunk\n";
            }),
            "m.safetensors: has 2 learnt styles and lists 1 in all; expected a model written by "
            "panache");
}

}  // namespace
}  // namespace panache
