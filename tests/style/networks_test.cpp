// StyleNetworks: how strengths mix, how far exaggeration goes, and when the gate closes.

#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "make_model.h"
#include "net/layer.h"
#include "style/networks/networks.h"
#include "style_checks.h"

namespace panache {
namespace {

constexpr int kHidden = 16;  // Of the pose trunk of made models.

std::vector<float> answer(StyleNetworks& networks, const std::vector<float>& window,
                          const std::vector<float>& strengths) {
  networks.set_strengths(strengths);
  networks.forward(window);
  return {networks.pose().begin(), networks.pose().end()};
}

// What the head of style 0 answers to activations that are all `feature`.
std::vector<float> answer_to(const TensorFile& file, float feature) {
  const std::vector<float>& weights = file.tensors.at("pose.head.0.weight").values;
  std::vector<float> out = file.tensors.at("pose.head.0.bias").values;
  for (size_t i = 0; i < weights.size(); ++i) out[i % out.size()] += feature * weights[i];
  for (size_t i = 0; i < out.size(); ++i) out[i] *= file.tensors.at("output.scale").values[i];
  return out;
}

void expect_near(const std::vector<float>& a, const std::vector<float>& b, float tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], tolerance) << "number " << i;
}

TEST(Networks, up_to_strength_one_styles_act_linearly_and_add_up) {
  const auto model = read(test::make_model({"old", "proud"}));
  StyleNetworks networks(model);
  const std::vector<float> window = window_of(1);
  const auto a = answer(networks, window, {1, 0}), b = answer(networks, window, {0, 1});
  const auto both = answer(networks, window, {0.5f, -0.7f});
  for (const float none : answer(networks, window, {0, 0})) EXPECT_EQ(none, 0);
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(both[i], 0.5f * a[i] - 0.7f * b[i], 1e-5);  // Sums of 16 products below 1.
  }
}

TEST(Networks, the_pose_grows_evenly_up_to_strength_2_and_more_slowly_beyond) {
  const auto model = read(test::make_model({"old"}));
  StyleNetworks networks(model);
  const std::vector<float> window = window_of(1);
  const auto one = answer(networks, window, {1}), two = answer(networks, window, {2});
  const auto three = answer(networks, window, {3}), below = answer(networks, window, {-3});
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_NEAR(two[i], 2 * one[i], 1e-5);
    EXPECT_NEAR(three[i], 2.3 * one[i], 1e-5);
    EXPECT_NEAR(below[i], -three[i], 1e-5);
  }
}

TEST(Networks, tempo_grows_more_slowly_beyond_strength_1) {
  const auto model = read(test::make_model({"old"}));
  StyleNetworks networks(model);
  const std::vector<float> window = window_of(1);
  answer(networks, window, {1});
  const float one = networks.log_rate();
  answer(networks, window, {2});
  EXPECT_NEAR(networks.log_rate() / one, 1.3, 1e-3);
}

TEST(Networks, each_style_has_its_own_tempo_and_contacts) {
  TensorFile file = test::make_model({"old", "proud"}), swapped = file;
  for (const char* part : {".weight", ".bias"}) {
    const auto swap = [&](const std::string& a, const std::string& b) {
      std::swap(swapped.tensors[a + part], swapped.tensors[b + part]);
    };
    swap("pose.head.0", "pose.head.1");
    swap("timing.head.0", "timing.head.1");
    swap("contact.head.1", "contact.head.2");  // Before them that of no style.
  }
  StyleNetworks one(read(file)), other(read(swapped));
  const std::vector<float> window = window_of(1);
  const auto rate = [&](StyleNetworks& networks, const std::vector<float>& strengths) {
    answer(networks, window, strengths);
    return std::array{networks.log_rate(), networks.contact()[0], networks.contact()[1]};
  };
  EXPECT_EQ(rate(one, {1, 0}), rate(other, {0, 1}));
  EXPECT_EQ(rate(one, {0, 1}), rate(other, {1, 0}));
  EXPECT_NE(rate(one, {1, 0}), rate(one, {0, 1}));
}

TEST(Networks, in_int8_answer_like_float_ones) {
  const TensorFile file = test::make_model({"old"});
  StyleNetworks whole(read(file)), int8(read(quantize(file)));
  const std::vector<float> window = window_of(1), strengths = {1};
  const auto a = answer(whole, window, strengths), b = answer(int8, window, strengths);
  double apart = 0, size = 0;
  for (size_t i = 0; i < a.size(); ++i) {
    apart += std::pow(double(a[i]) - double(b[i]), 2), size += std::pow(double(a[i]), 2);
  }
  EXPECT_GT(apart, 0);
  // Three layers of weights that are off by up to a 254th of the largest of their column.
  EXPECT_LT(std::sqrt(apart / size), 0.03);
}

// The units of a head that reads combinations of activations are the last layer's here, so the
// answers are those of a head that reads this layer, with any gate.
TEST(ReducedHeads, answer_as_heads_on_the_last_layer_where_they_read_only_that) {
  for (const float limit : {1e3f, 1.0f, 1e-4f}) {
    TensorFile file = test::make_model({"old", "proud"});
    test::add_gate(file, limit, 0.3f);
    StyleNetworks direct(read(file));
    test::reduce_heads(file, 0, 0.3f);
    StyleNetworks reduced(read(file));
    const auto expected = answer(direct, window_of(2), {0.7f, -0.4f});
    const auto got = answer(reduced, window_of(2), {0.7f, -0.4f});
    EXPECT_EQ(reduced.gate(), direct.gate());
    expect_near(got, expected, 1e-6f);  // Sums of 16 products below 1, times 0.1.
    for (const float none : answer(reduced, window_of(2), {0, 0})) EXPECT_EQ(none, 0);
  }
}

TEST(ReducedHeads, read_the_first_layer_too) {
  TensorFile file = test::make_model({"old"});
  test::reduce_heads(file, 0);
  StyleNetworks last(read(file));
  test::reduce_heads(file, 0.5f);
  StyleNetworks all(read(file));
  const auto a = answer(last, window_of(1), {1}), b = answer(all, window_of(1), {1});
  float max = 0;
  for (size_t i = 0; i < a.size(); ++i) max = std::max(max, std::abs(a[i] - b[i]));
  EXPECT_GT(max, 0.01f);
}

TEST(ReducedHeads, of_the_wrong_shape_are_rejected) {
  TensorFile file = test::make_model({"old"});
  test::reduce_heads(file, 0);
  file.tensors["pose.reduce.0.weight"] = test::constant_tensor(3, 0);
  EXPECT_EQ(Model::create(file, "m").error().message,
            "m: tensor 'pose.reduce.0.weight' has shape [3]; expected [32, any]");
  test::reduce_heads(file, 0);
  file.tensors.erase("pose.reduce.0.bias");
  EXPECT_FALSE(Model::create(file, "m").ok());
}

TEST(Gate, a_model_without_one_trusts_everything) {
  StyleNetworks networks(read(test::make_model({"old"})));
  answer(networks, window_of(100), {1});
  EXPECT_EQ(networks.gate(), 1);
}

TEST(Gate, a_near_window_leaves_it_wide_open_and_its_answer_untouched) {
  TensorFile file = test::make_model({"old"});
  StyleNetworks without(read(file));
  test::add_gate(file, 1e3f, 0.3f);
  StyleNetworks networks(read(file));
  const std::vector<float> window = window_of(1);
  EXPECT_EQ(answer(networks, window, {1}), answer(without, window, {1}));
  EXPECT_EQ(networks.gate(), 1);
}

TEST(Gate, a_far_window_closes_it_and_the_nearer_half_less) {
  TensorFile file = test::make_model({"old"});
  file.tensors["input.clip"].values = {0};
  test::add_gate(file, 10);
  StyleNetworks networks(read(file));
  answer(networks, window_of(1000), {1});
  EXPECT_LT(networks.gate(), 1e-3f);
  answer(networks, window_of(10), {1});
  const float middle = networks.gate();
  EXPECT_GT(middle, 1e-3f);
  EXPECT_LT(middle, 1);
}

TEST(Gate, closed_it_gives_the_styles_mean_answer_whatever_the_motion) {
  TensorFile file = test::make_model({"old"});
  test::add_gate(file, 1e-4f, 0.3f);
  StyleNetworks networks(read(file));
  const std::vector<float> mean = answer_to(file, 0.3f);
  for (const uint64_t seed : {1, 2}) {
    // Heads are sums of 16 products below 1, times 0.1.
    expect_near(answer(networks, window_of(1, seed), {1}), mean, 1e-6f);
  }
}

TEST(Gate, half_open_it_gives_the_answer_to_features_drawn_to_their_mean) {
  TensorFile file = test::make_model({"old"});
  StyleNetworks without(read(file));
  test::add_gate(file, 1, 0.3f);
  StyleNetworks networks(read(file));
  const std::vector<float> window = window_of(1), open = answer(without, window, {1});
  const std::vector<float> mean = answer_to(file, 0.3f), got = answer(networks, window, {1});
  const float gate = networks.gate();
  ASSERT_GT(gate, 0.01f);
  ASSERT_LT(gate, 0.99f);
  for (size_t i = 0; i < got.size(); ++i) {
    EXPECT_NEAR(got[i], mean[i] + gate * (open[i] - mean[i]), 1e-6) << i;
  }
}

TEST(Gate, it_moves_by_the_share_it_is_given) {
  TensorFile file = test::make_model({"old"});
  test::add_gate(file, 1e-3f);
  StyleNetworks networks(read(file));
  const std::vector<float> strengths = {1}, window = window_of(1);
  networks.set_strengths(strengths);
  networks.forward(window, 0.25f);
  EXPECT_NEAR(networks.gate(), 0.75f, 1e-3);
  networks.forward(window, 0.25f);
  EXPECT_NEAR(networks.gate(), 0.75f * 0.75f, 1e-3);
}

TEST(Gate, distance_is_measured_after_whitening_and_from_the_mean) {
  // Features are constants: without weights the trunk answers with its last bias, kept by ELU.
  TensorFile file = test::make_model({"old"});
  for (const char* name : {"pose.trunk.0.weight", "pose.trunk.1.weight"}) {
    for (float& w : file.tensors[name].values) w = 0;
  }
  file.tensors["pose.trunk.1.bias"] = test::constant_tensor(kHidden, 1);
  test::add_gate(file, 1, 0.5f);
  // 16 differences of 0.5: a distance of 2, half of which is trusted.
  StyleNetworks plain(read(file));
  answer(plain, window_of(1), {1});
  EXPECT_NEAR(plain.gate(), std::pow(0.5, 4), 1e-6);
  for (float& w : file.tensors["gate.whitening.weight"].values) w *= 0.75f;
  StyleNetworks whitened(read(file));
  answer(whitened, window_of(1), {1});
  EXPECT_NEAR(whitened.gate(), std::pow(1 / 1.5, 4), 1e-6);
  for (float& w : file.tensors["gate.whitening.weight"].values) w *= 0.5f;
  StyleNetworks within(read(file));
  answer(within, window_of(1), {1});
  EXPECT_EQ(within.gate(), 1);
}

}  // namespace
}  // namespace panache
