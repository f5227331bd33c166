#pragma once
// Layers over time, and how they learn.

#include <functional>
#include <vector>

#include <torch/types.h>

#include "base/random.h"

namespace panache::holden2017 {

// One convolution over time; the ends are held, so that as many frames come out as go in.
struct Convolution {
  static constexpr int kReach = 6;  // Frames to either side: 13 in all, 0.43 s.

  torch::Tensor weight, bias;  // [out][in][2 * kReach + 1], [out]

  Convolution() = default;
  // Weights are uniform, as large as keeps activations of ReLUs as large as they were; none where
  // `random` is null.
  Convolution(int in, int out, Random* random);
  torch::Tensor operator()(const torch::Tensor& x) const;  // [windows][in][frames]
  int64_t parameters() const { return weight.numel() + bias.numel(); }
};

// Takes `steps` of Adam (Kingma and Ba 2015) down the gradients of loss(step), at a rate that falls
// from `rate` to a hundredth of it; the layers stay as they are afterwards.
void learn(const std::vector<Convolution*>& layers, int steps, double rate,
           const std::function<torch::Tensor(int step)>& loss);

}  // namespace panache::holden2017
