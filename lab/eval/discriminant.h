#pragma once
// A second style classifier, of another family than the networks that guide and evaluate elsewhere:
// linear discriminant analysis of simple statistics of one second of motion. Motion that fools a
// network does not fool it.

#include <string>
#include <vector>

#include <torch/types.h>

#include "learn/take.h"
#include "train/linear_discriminant.h"

namespace panache {

class Discriminant {
 public:
  // Learns to predict labels[i] from takes[i]; skips takes whose label is not among `classes`.
  // Windows have this many frames of a take. A style and its mirror image are two. `shifts`: for
  // each take what is added to the statistics of its windows, [statistics]; empty: nothing.
  Discriminant(const std::vector<Take>& takes, const std::vector<std::string>& labels,
               const std::vector<std::string>& classes,
               int window_frames = static_cast<int>(kTakeRate),
               const std::vector<torch::Tensor>& shifts = {});

  // Log-likelihoods of the classes up to a constant. `shift`, if defined, is added to the
  // statistics of every window. [windows][classes]
  torch::Tensor scores(const Take& take, const torch::Tensor& shift = {}) const;
  // Mean over the windows of a take; the first for windows of any length. [statistics]
  static torch::Tensor mean_statistics(const Take& take, int window_frames);
  torch::Tensor mean_statistics(const Take& take) const;

 private:
  int window_frames_;
  LinearDiscriminant discriminant_;
};

}  // namespace panache
