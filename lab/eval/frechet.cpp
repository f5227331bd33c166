#include "eval/evaluator.h"

#include <algorithm>

namespace panache {
namespace {

torch::Tensor covariance(const torch::Tensor& centred) {
  return torch::mm(centred.t(), centred) / std::max<double>(1, double(centred.size(0)) - 1);
}

}  // namespace

double frechet_distance(const torch::Tensor& a, const torch::Tensor& b) {
  torch::NoGradGuard no_gradients;
  const torch::Tensor x = a.to(torch::kFloat64), y = b.to(torch::kFloat64);
  const torch::Tensor x_mean = x.mean(0), y_mean = y.mean(0);
  const torch::Tensor x_cov = covariance(x - x_mean), y_cov = covariance(y - y_mean);
  // tr((A B)^(1/2)) = tr((A^(1/2) B A^(1/2))^(1/2)), whose argument is symmetric.
  const auto [values, vectors] = torch::linalg_eigh(x_cov);
  const torch::Tensor root =
      torch::mm(vectors * values.clamp_min(0).sqrt().unsqueeze(0), vectors.t());
  const torch::Tensor both = torch::linalg_eigvalsh(torch::mm(torch::mm(root, y_cov), root));
  const double overlap = both.clamp_min(0).sqrt().sum().item<double>();
  const double distance = (x_mean - y_mean).square().sum().item<double>() +
                          x_cov.trace().item<double>() + y_cov.trace().item<double>() - 2 * overlap;
  return std::max(distance, 0.0);
}

}  // namespace panache
