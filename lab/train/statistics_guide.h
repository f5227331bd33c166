#pragma once
// A guide of another family than the networks: a linear discriminant of a few statistics of a
// second of motion. What fools the networks does not fool it, and the other way round.

#include <string>
#include <vector>

#include <torch/types.h>

#include "learn/take.h"
#include "train/linear_discriminant.h"

namespace panache {

// The joint at the upper end of each bone; bone j - 1 leads to joint j. [20]
const torch::Tensor& bone_parents();

// Of sequences of bodies: mean and deviation of each bone's direction, how fast each joint moves,
// how high the hips are and how much they bob. bodies[sequences][kSequenceInstants][21][3] ->
// [sequences][statistics]
torch::Tensor motion_statistics(const torch::Tensor& bodies);

class StatisticsGuide {
 public:
  // Learns to tell the class labels[i] of takes[i] apart, each mirrored too; takes whose label is
  // not among `classes` are left out.
  StatisticsGuide(const std::vector<Take>& takes, const std::vector<std::string>& labels,
                  const std::vector<std::string>& classes);

  // Cross-entropy of wanted[i] for sequence i, the mean, with gradients for the bodies. bodies as
  // above.
  torch::Tensor loss(const torch::Tensor& bodies, const torch::Tensor& wanted,
                     float smoothing) const;

 private:
  LinearDiscriminant discriminant_;
};

}  // namespace panache
