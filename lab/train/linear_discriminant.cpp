#include "train/linear_discriminant.h"

namespace panache {
namespace {

constexpr double kMinDeviation = 0.02;  // Of a statistic.
constexpr double kShrinkage = 0.15;     // Of the covariance, towards a multiple of the identity.
constexpr double kOutlier = 4;          // Deviations.

}  // namespace

std::vector<torch::Tensor> rows_of_classes(
    const std::vector<Take>& takes, const std::vector<std::string>& labels,
    const std::vector<std::string>& classes, int64_t size,
    const std::function<torch::Tensor(const Take&)>& rows_of) {
  std::vector<torch::Tensor> rows;
  for (const std::string& label : classes) {
    std::vector<torch::Tensor> parts = {torch::empty({0, size}, torch::kFloat64)};
    for (size_t t = 0; t < takes.size(); ++t) {
      if (labels[t] == label) parts.push_back(rows_of(takes[t]));
    }
    rows.push_back(torch::cat(parts));
  }
  return rows;
}

LinearDiscriminant::LinearDiscriminant(const std::vector<torch::Tensor>& rows_of_class) {
  torch::NoGradGuard no_gradients;
  const torch::Tensor all = torch::cat(rows_of_class);
  mean_ = all.mean(0);
  scale_ = all.std(0, false) + kMinDeviation;
  const int64_t size = all.size(1), classes = static_cast<int64_t>(rows_of_class.size());
  std::vector<torch::Tensor> means;
  torch::Tensor covariance = torch::zeros({size, size}, torch::kFloat64);
  for (const torch::Tensor& rows : rows_of_class) {
    const torch::Tensor own =
        rows.size(0) ? (rows - mean_) / scale_ : torch::zeros({1, size}, torch::kFloat64);
    means.push_back(own.mean(0));
    const torch::Tensor centred = own - means.back();
    covariance += torch::mm(centred.t(), centred) / static_cast<double>(own.size(0) * classes);
  }
  const torch::Tensor level = covariance.trace() / size;
  covariance =
      (1 - kShrinkage) * covariance + kShrinkage * level * torch::eye(size, torch::kFloat64);
  const torch::Tensor centres = torch::stack(means);
  weights_ = torch::linalg_solve(covariance, centres.t());
  bias_ = -0.5 * (centres * weights_.t()).sum(1);
}

torch::Tensor LinearDiscriminant::scores(const torch::Tensor& rows) const {
  return torch::mm(((rows - mean_) / scale_).clamp(-kOutlier, kOutlier), weights_) + bias_;
}

}  // namespace panache
