#include "eval/systems/holden2017/convolution.h"

#include <cmath>
#include <numbers>

#include <torch/nn/functional/padding.h>
#include <torch/optim/adam.h>

namespace panache::holden2017 {

Convolution::Convolution(int in, int out, Random* random)
    : weight(torch::zeros({out, in, 2 * kReach + 1})), bias(torch::zeros({out})) {
  if (!random) return;
  const float bound = std::sqrt(6.0f / static_cast<float>(weight[0].numel()));
  float* w = weight.data_ptr<float>();
  for (int64_t i = 0; i < weight.numel(); ++i) w[i] = bound * (2 * random->uniform() - 1);
}

torch::Tensor Convolution::operator()(const torch::Tensor& x) const {
  namespace F = torch::nn::functional;
  const torch::Tensor held = F::pad(x, F::PadFuncOptions({kReach, kReach}).mode(torch::kReplicate));
  return torch::conv1d(held, weight, bias);
}

void learn(const std::vector<Convolution*>& layers, int steps, double rate,
           const std::function<torch::Tensor(int step)>& loss) {
  std::vector<torch::Tensor> numbers;
  for (Convolution* layer : layers) {
    for (torch::Tensor* part : {&layer->weight, &layer->bias}) {
      part->set_requires_grad(true);
      numbers.push_back(*part);
    }
  }
  torch::optim::Adam adam(numbers, torch::optim::AdamOptions(rate));
  for (int step = 0; step < steps; ++step) {
    const double share = 0.5 + 0.5 * std::cos(std::numbers::pi * step / steps);
    static_cast<torch::optim::AdamOptions&>(adam.param_groups()[0].options())
        .lr(rate * (0.01 + 0.99 * share));
    adam.zero_grad();
    loss(step).backward();
    adam.step();
  }
  for (torch::Tensor& part : numbers) part.set_requires_grad(false);
}

}  // namespace panache::holden2017
