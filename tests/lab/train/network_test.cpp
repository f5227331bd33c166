#include <gtest/gtest.h>
#include <torch/optim/adam.h>

#include "make_styled_takes.h"
#include "train/classifier.h"
#include "train/matrix_products.h"
#include "train/network.h"

namespace panache {
namespace {

constexpr NetworkShape kShape{"pose", 8, 16, 3, 4, 3, false, false};

torch::Tensor filled(int64_t rows, int64_t columns, uint64_t seed) {
  torch::Tensor tensor = torch::empty({rows, columns});
  Random random(seed);
  for (int64_t i = 0; i < tensor.numel(); ++i) tensor.data_ptr<float>()[i] = random.normal();
  return tensor;
}

// Trains on a fixed task for `steps`; returns the last loss.
float train_for(NetworkTrainer& network, int64_t steps) {
  const torch::Tensor x = filled(60, 8, 1);
  const torch::Tensor y = torch::cat({x.slice(1, 0, 4), x.slice(1, 4, 8)}).slice(0, 0, 60);
  float last = 0;
  for (int64_t i = 0; i < steps; ++i) {
    const torch::Tensor loss = (network.forward(x, {20, 20, 20}, nullptr) - y).square().mean();
    network.learn(loss);
    last = loss.item<float>();
  }
  return last;
}

TEST(Network, learning_lowers_the_loss) {
  NetworkTrainer network(kShape, {}, 200, 1);
  const float before = train_for(network, 1);
  EXPECT_LT(train_for(network, 199), before * 0.2f);
}

TEST(Network, our_adam_is_libtorchs) {
  // One layer of weights followed for ten steps by both; the decay is AdamW's, on weights only.
  const NetworkShape shape{"pose", 8, 16, 1, 4, 1, false, false};
  OptimizerSettings settings;
  settings.learning_rate = 0.02f;
  NetworkTrainer network(shape, settings, 10, 4);
  TensorFile start;
  network.write(start);
  const auto parameter = [&](const std::string& key) {
    const Tensor& t = start.tensors.at(key);
    return torch::tensor(t.values).view(t.shape).set_requires_grad(true);
  };
  torch::Tensor w0 = parameter("pose.trunk.0.weight"), b0 = parameter("pose.trunk.0.bias");
  torch::Tensor w1 = parameter("pose.head.0.weight"), b1 = parameter("pose.head.0.bias");
  torch::optim::Adam reference({w0, b0, w1, b1}, torch::optim::AdamOptions(0.02));
  const torch::Tensor x = filled(32, 8, 2), y = filled(32, 4, 3);
  for (int i = 0; i < 10; ++i) {
    network.learn((network.forward(x, {32}, nullptr) - y).square().mean());
    reference.zero_grad();
    const torch::Tensor out = torch::addmm(b1, torch::elu(torch::addmm(b0, x, w0)), w1);
    (out - y).square().mean().backward();
    reference.step();
  }
  TensorFile end;
  network.write(end);
  const torch::Tensor ours = torch::tensor(end.tensors.at("pose.trunk.0.weight").values);
  // Ten steps of 0.02 each, summed in another order.
  EXPECT_LT((ours - w0.detach().flatten()).abs().max().item<float>(), 1e-4f);
}

TEST(Network, going_on_from_a_saved_state_is_as_if_never_stopped) {
  NetworkTrainer whole(kShape, {}, 40, 9), first(kShape, {}, 40, 9), second(kShape, {}, 40, 1234);
  train_for(whole, 40);
  train_for(first, 20);
  ASSERT_TRUE(second.restore(first.save()));
  EXPECT_EQ(second.step(), 20);
  train_for(second, 20);
  EXPECT_TRUE(torch::equal(whole.save()[0], second.save()[0]));
}

TEST(Network, a_state_of_another_shape_is_rejected) {
  NetworkShape other = kShape;
  other.hidden = 17;
  NetworkTrainer network(kShape, {}, 1, 1), stranger(other, {}, 1, 1);
  EXPECT_FALSE(network.restore(stranger.save()));
}

TEST(Network, a_base_head_is_added_to_every_other) {
  NetworkShape shape = kShape;
  shape.base = true;
  shape.heads = 4;
  NetworkTrainer network(shape, {}, 1, 5);
  TensorFile file;
  network.write(file);
  const torch::Tensor x = torch::zeros({1, 8});
  const torch::Tensor second = network.forward(x, {0, 1, 0}, nullptr);
  const torch::Tensor third = network.forward(x, {0, 0, 1}, nullptr);
  EXPECT_FALSE(torch::equal(second, third));
  EXPECT_EQ(file.tensors.count("pose.head.3.weight"), 1u);
}

std::vector<std::string> styles_of(const std::vector<Take>& takes) {
  std::vector<std::string> labels;
  for (const Take& take : takes) labels.push_back(take.row.style);
  return labels;
}

// To train a classifier takes seconds, so two answer all questions.
TEST(Classifier, learns_its_classes_alone_and_the_same_from_the_same_seed) {
  EXPECT_TRUE(prepare_matrix_products().ok());
  std::vector<Take> takes = test::styled_takes({"old", "proud"}, {0});
  std::vector<std::string> labels = styles_of(takes);
  const Classifier without(takes, labels, {"proud", "old"}, 3);
  // Takes of no class are not learnt from: they change nothing at all.
  for (const Take& take : test::styled_takes({"neutral"}, {1, 2})) {
    takes.push_back(take);
    labels.push_back("jolly");
  }
  const Classifier classifier(takes, labels, {"proud", "old"}, 3);
  EXPECT_EQ(classifier.find("old"), 1);
  EXPECT_EQ(classifier.find("jolly"), -1);
  const Take stranger = test::styled_take("neutral", "walk", 1);
  EXPECT_TRUE(torch::equal(classifier.classify(stranger).probabilities,
                           without.classify(stranger).probabilities));

  const Classification classified = classifier.classify(test::styled_take("old", "walk", 3, 90));
  ASSERT_EQ(classified.probabilities.size(0), 7);  // 29 frames each, 10 apart, in 90 frames.
  EXPECT_EQ(classified.probabilities.size(1), 2);
  EXPECT_EQ(classified.features.size(0), 7);
  EXPECT_LT((classified.probabilities.sum(1) - 1).abs().max().item<float>(), 1e-5f);
  EXPECT_GT(classified.probabilities.select(1, 1).min().item<float>(), 0.9f);

  // What is shorter than a window is held at its last frame.
  const Classification one = classifier.classify(test::styled_take("proud", "walk", 3, 12));
  ASSERT_EQ(one.probabilities.size(0), 1);
  EXPECT_GT(one.probabilities[0][0].item<float>(), 0.5f);
}

}  // namespace
}  // namespace panache
