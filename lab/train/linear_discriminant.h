#pragma once
// Linear discriminant analysis: classes told apart by their means, with one covariance for all.

#include <functional>
#include <string>
#include <vector>

#include <torch/types.h>

#include "learn/take.h"

namespace panache {

// The rows that rows_of() makes of the takes of each class; labels[i] is the class of takes[i].
// Skips takes of no class. [classes] of [rows][size], 64 bits
std::vector<torch::Tensor> rows_of_classes(
    const std::vector<Take>& takes, const std::vector<std::string>& labels,
    const std::vector<std::string>& classes, int64_t size,
    const std::function<torch::Tensor(const Take&)>& rows_of);

class LinearDiscriminant {
 public:
  // rows_of_class[class]: [rows][size], 64 bits; a class may have none.
  explicit LinearDiscriminant(const std::vector<torch::Tensor>& rows_of_class);

  // Log-likelihoods of the classes up to a constant, differentiable with respect to the rows, which
  // are 64 bits too. [rows][size] -> [rows][classes]
  torch::Tensor scores(const torch::Tensor& rows) const;

 private:
  torch::Tensor mean_, scale_;  // [size]
  torch::Tensor weights_;       // [size][classes]
  torch::Tensor bias_;          // [classes]
};

}  // namespace panache
