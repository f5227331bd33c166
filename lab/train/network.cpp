#include "train/network.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace panache {
namespace {

// Adam's usual constants.
constexpr float kBeta1 = 0.9f, kBeta2 = 0.999f;
// The one-cycle schedule: warm-up share, first and last rate relative to the highest.
constexpr double kWarmUp = 0.3, kFirst = 1.0 / 25, kLast = 1.0 / 25e4;

double cosine(double from, double to, double share) {
  return to + (from - to) * (1 + std::cos(std::numbers::pi * share)) / 2;
}

}  // namespace

Tensor to_tensor(const torch::Tensor& values, bool half) {
  const torch::Tensor flat = values.detach().to(torch::kFloat32).contiguous();
  Tensor tensor;
  tensor.shape.assign(flat.sizes().begin(), flat.sizes().end());
  tensor.values.assign(flat.data_ptr<float>(), flat.data_ptr<float>() + flat.numel());
  tensor.half = half;
  return tensor;
}

NetworkTrainer::NetworkTrainer(const NetworkShape& shape, const OptimizerSettings& settings,
                               int64_t steps, uint64_t seed)
    : shape_(shape), settings_(settings), steps_(steps) {
  struct Part {
    std::vector<int64_t> sizes;
    int fan_in;
    bool decays;
  };
  std::vector<Part> parts;
  for (int l = 0; l < shape.layers; ++l) {
    const int in = l == 0 ? shape.inputs : shape.hidden;
    parts.push_back({{in, shape.hidden}, in, true});
    parts.push_back({{shape.hidden}, in, false});
  }
  parts.push_back({{shape.heads, shape.hidden, shape.outputs}, shape.hidden, true});
  parts.push_back({{shape.heads, shape.outputs}, shape.hidden, false});

  int64_t total = 0;
  for (const Part& part : parts) total += c10::multiply_integers(part.sizes);
  numbers_ = torch::empty(total);
  gradient_ = torch::zeros(total);
  mean_ = torch::zeros(total);
  square_ = torch::zeros(total);
  decay_ = torch::zeros(total);

  // Uniform within 1/sqrt(inputs), the default of frameworks in the slides' time.
  Random random(seed);
  int64_t at = 0;
  std::vector<torch::Tensor> views;
  for (const Part& part : parts) {
    const int64_t count = c10::multiply_integers(part.sizes);
    const float bound = 1 / std::sqrt(static_cast<float>(part.fan_in));
    float* number = numbers_.data_ptr<float>() + at;
    for (int64_t i = 0; i < count; ++i) number[i] = bound * (2 * random.uniform() - 1);
    if (part.decays) decay_.narrow(0, at, count).fill_(1);
    torch::Tensor view = numbers_.narrow(0, at, count).view(part.sizes).detach();
    view.set_requires_grad(true);
    view.mutable_grad() = gradient_.narrow(0, at, count).view(part.sizes);
    views.push_back(view);
    at += count;
  }
  for (int l = 0; l < shape.layers; ++l) {
    weights_.push_back(views[2 * l]);
    biases_.push_back(views[2 * l + 1]);
  }
  heads_ = views[2 * shape.layers];
  head_biases_ = views[2 * shape.layers + 1];
}

torch::Tensor NetworkTrainer::activations(const torch::Tensor& x) const {
  std::vector<torch::Tensor> layers;
  torch::Tensor h = x;
  for (int l = 0; l < shape_.layers; ++l) {
    h = torch::elu(torch::addmm(biases_[l], h, weights_[l]));
    layers.push_back(h);
  }
  return torch::cat(layers, 1);
}

torch::Tensor NetworkTrainer::hidden(const torch::Tensor& x, Random* random) const {
  torch::Tensor h = x;
  const float keep = 1 - settings_.dropout;
  for (int l = 0; l < shape_.layers; ++l) {
    h = torch::elu(torch::addmm(biases_[l], h, weights_[l]));
    if (!random || settings_.dropout <= 0) continue;
    torch::Tensor mask = torch::empty_like(h, torch::TensorOptions().requires_grad(false));
    float* m = mask.data_ptr<float>();
    for (int64_t i = 0; i < mask.numel(); ++i) m[i] = random->uniform() < keep ? 1 / keep : 0.0f;
    h = h * mask;
  }
  return h;
}

torch::Tensor NetworkTrainer::forward(const torch::Tensor& x,
                                      const std::vector<int64_t>& group_sizes,
                                      Random* random) const {
  const torch::Tensor h = hidden(x, random);
  if (shape_.heads == 1) return torch::addmm(head_biases_[0], h, heads_[0]);
  const std::vector<torch::Tensor> rows = h.split_with_sizes(group_sizes);
  std::vector<torch::Tensor> out;
  for (size_t g = 0; g < rows.size(); ++g) {
    if (group_sizes[g] == 0) continue;
    const int64_t head = static_cast<int64_t>(g) + shape_.base;
    torch::Tensor bias = head_biases_[head], weights = heads_[head];
    if (shape_.base) {
      bias = bias + head_biases_[0];
      weights = weights + heads_[0];
    }
    out.push_back(torch::addmm(bias, rows[g], weights));
  }
  return torch::cat(out);
}

float NetworkTrainer::learning_rate() const {
  if (!settings_.one_cycle) return settings_.learning_rate;
  const double share =
      static_cast<double>(step_) / static_cast<double>(std::max<int64_t>(steps_, 1));
  const double factor = share < kWarmUp ? cosine(kFirst, 1, share / kWarmUp)
                                        : cosine(1, kLast, (share - kWarmUp) / (1 - kWarmUp));
  return settings_.learning_rate * static_cast<float>(factor);
}

void NetworkTrainer::learn(const torch::Tensor& loss) {
  gradient_.zero_();
  loss.backward();
  torch::NoGradGuard no_gradients;
  const float rate = learning_rate();
  ++step_;
  if (settings_.weight_decay > 0) {
    numbers_.addcmul_(numbers_, decay_, -rate * settings_.weight_decay);
  }
  mean_.mul_(kBeta1).add_(gradient_, 1 - kBeta1);
  square_.mul_(kBeta2).addcmul_(gradient_, gradient_, 1 - kBeta2);
  const double correct1 = 1 - std::pow(double{kBeta1}, static_cast<double>(step_));
  const double correct2 = 1 - std::pow(double{kBeta2}, static_cast<double>(step_));
  const torch::Tensor root = (square_ / correct2).sqrt_().add_(settings_.epsilon);
  numbers_.addcdiv_(mean_, root, -rate / correct1);
}

void NetworkTrainer::freeze() {
  for (torch::Tensor& weight : weights_) weight.set_requires_grad(false);
  for (torch::Tensor& bias : biases_) bias.set_requires_grad(false);
  heads_.set_requires_grad(false);
  head_biases_.set_requires_grad(false);
}

std::vector<torch::Tensor> NetworkTrainer::save() const {
  return {numbers_.clone(), mean_.clone(), square_.clone(), torch::tensor(step_)};
}

bool NetworkTrainer::restore(const std::vector<torch::Tensor>& saved) {
  if (saved.size() != 4 || saved[0].sizes() != numbers_.sizes()) return false;
  torch::NoGradGuard no_gradients;
  numbers_.copy_(saved[0]);
  mean_.copy_(saved[1]);
  square_.copy_(saved[2]);
  step_ = saved[3].item<int64_t>();
  return true;
}

void NetworkTrainer::round_halves() {
  if (!shape_.half) return;
  torch::NoGradGuard no_gradients;
  float* number = heads_.data_ptr<float>();
  for (int64_t i = 0; i < heads_.numel(); ++i) number[i] = from_half(to_half(number[i]));
}

void NetworkTrainer::write(TensorFile& file) const {
  for (int l = 0; l < shape_.layers; ++l) {
    const std::string prefix = shape_.name + ".trunk." + std::to_string(l);
    file.tensors[prefix + ".weight"] = to_tensor(weights_[l]);
    file.tensors[prefix + ".bias"] = to_tensor(biases_[l]);
  }
  for (int h = 0; h < shape_.heads; ++h) {
    const std::string prefix = shape_.name + ".head." + std::to_string(h);
    file.tensors[prefix + ".weight"] = to_tensor(heads_[h], shape_.half);
    file.tensors[prefix + ".bias"] = to_tensor(head_biases_[h]);
  }
}

}  // namespace panache
