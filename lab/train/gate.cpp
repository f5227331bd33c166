#include "train/fit_heads.h"

#include <algorithm>

#include "train/network.h"

namespace panache {
namespace {

// Directions with hardly any variance are unreliable for telling what is unknown.
constexpr double kRidge = 0.02;  // Of the mean variance.
// The rest are transitions and odd moments, where out-of-distribution motion begins.
constexpr double kQuantile = 0.99;

}  // namespace

void fit_gate(const torch::Tensor& rows, TensorFile& file, double trusted) {
  torch::NoGradGuard no_gradients;
  const torch::Tensor activations = rows.to(torch::kFloat64);
  const torch::Tensor mean = activations.mean(0);
  const torch::Tensor centred = activations - mean;
  const torch::Tensor covariance =
      torch::mm(centred.t(), centred) / static_cast<double>(activations.size(0) - 1);
  const auto [values, vectors] = torch::linalg_eigh(covariance);
  // Activations without any variance, as of a single pose, still make a gate.
  const torch::Tensor ridge = values.clamp_min(0) + (values.mean() * kRidge).clamp_min(1e-6);
  const torch::Tensor whitening = vectors / ridge.sqrt().unsqueeze(0);
  const torch::Tensor distance = torch::mm(centred, whitening).square().sum(1).sqrt();
  const double limit = std::max(1.0, trusted * distance.quantile(kQuantile).item<double>());

  file.tensors["gate.mean"] = to_tensor(mean);
  file.tensors["gate.whitening.weight"] = to_tensor(whitening, true);
  file.tensors["gate.whitening.bias"] = to_tensor(torch::zeros({mean.size(0)}));
  file.tensors["gate.limit"] = to_tensor(torch::full({1}, limit));
}

}  // namespace panache
