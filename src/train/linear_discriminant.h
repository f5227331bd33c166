#pragma once
// Linear discriminant analysis: classes told apart by their means, with one covariance for all.

#include <vector>

#include <torch/torch.h>

namespace panache {

class LinearDiscriminant {
 public:
  // rows_of_class[class]: [rows][size], 64 bits; a class may have none.
  explicit LinearDiscriminant(const std::vector<torch::Tensor>& rows_of_class);

  // Logarithms of what speaks for each class, but for a constant; with gradients for the rows,
  // which are 64 bits too. [rows][size] -> [rows][classes]
  torch::Tensor scores(const torch::Tensor& rows) const;

 private:
  torch::Tensor mean_, scale_;  // [size]
  torch::Tensor weights_;       // [size][classes]
  torch::Tensor bias_;          // [classes]
};

}  // namespace panache
