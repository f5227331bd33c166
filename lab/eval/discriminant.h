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
  // not among `classes` are left out. It looks at windows of so many frames of a take.
  Discriminant(const std::vector<Take>& takes, const std::vector<std::string>& labels,
               const std::vector<std::string>& classes,
               int window_frames = static_cast<int>(kTakeRate));

  // Logarithms of what speaks for each class, but for a constant. `shift` is added to the
  // statistics of every window first; undefined, nothing is. [windows][classes]
  torch::Tensor scores(const Take& take, const torch::Tensor& shift = {}) const;
  // Of the windows of a take, left as right too. [statistics]
  torch::Tensor mean_statistics(const Take& take) const;

 private:
  int window_frames_;
  LinearDiscriminant discriminant_;
};

}  // namespace panache
