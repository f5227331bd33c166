#pragma once
// A second judge of styles, of another family than the networks that guide and judge elsewhere:
// linear discriminant analysis of a few statistics of a second of motion. What fools a network does
// not fool it.

#include <string>
#include <vector>

#include <torch/types.h>

#include "learn/take.h"
#include "train/linear_discriminant.h"

namespace panache {

class Discriminant {
 public:
  // Learns to tell the class labels[i] of takes[i] apart, each mirrored too; takes whose label is
  // not among `classes` are left out.
  Discriminant(const std::vector<Take>& takes, const std::vector<std::string>& labels,
               const std::vector<std::string>& classes);

  // Logarithms of what speaks for each class, but for a constant. [windows][classes]
  torch::Tensor scores(const Take& take) const;

 private:
  LinearDiscriminant discriminant_;
};

}  // namespace panache
