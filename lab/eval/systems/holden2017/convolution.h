#pragma once
// Temporal convolutions and their training.

#include <functional>
#include <vector>

#include <torch/types.h>

#include "base/random.h"

namespace panache::holden2017 {

// One temporal convolution; edge padding keeps the number of frames.
struct Convolution {
  static constexpr int kReach = 6;  // Frames to either side: 13 in all, 0.43 s.

  torch::Tensor weight, bias;  // [out][in][2 * kReach + 1], [out]

  Convolution() = default;
  // Uniform weights, scaled to preserve the magnitude of ReLU activations; zero if `random` is
  // null.
  Convolution(int in, int out, Random* random);
  torch::Tensor operator()(const torch::Tensor& x) const;  // [windows][in][frames]
  int64_t parameters() const { return weight.numel() + bias.numel(); }
};

// Takes `steps` steps of Adam (Kingma and Ba 2015) on the gradients of loss(step), with a rate that
// falls from `rate` to a hundredth of it; then freezes the layers.
void learn(const std::vector<Convolution*>& layers, int steps, double rate,
           const std::function<torch::Tensor(int step)>& loss);

}  // namespace panache::holden2017
