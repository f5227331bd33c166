#pragma once
// A guide of another family than the networks: a linear discriminant of simple statistics of one
// second of motion. Motion that fools the networks does not fool it, and vice versa.

#include <string>
#include <vector>

#include <torch/types.h>

#include "learn/take.h"
#include "train/linear_discriminant.h"

namespace panache {

// The parent joint of each bone; bone j - 1 leads to joint j. [20]
const torch::Tensor& bone_parents();

// Statistics of sequences of bodies: mean and deviation of bone directions, joint speeds, height
// and bobbing of the hips.
// bodies[sequences][kSequenceInstants][21][3] -> [sequences][statistics]
torch::Tensor motion_statistics(const torch::Tensor& bodies);

class StatisticsGuide {
 public:
  // Learns to predict labels[i] from takes[i]; skips takes whose label is not among `classes`.
  StatisticsGuide(const std::vector<Take>& takes, const std::vector<std::string>& labels,
                  const std::vector<std::string>& classes);

  // Mean cross-entropy of wanted[i] for sequence i, with gradients for the bodies. `bodies` as
  // above.
  torch::Tensor loss(const torch::Tensor& bodies, const torch::Tensor& wanted,
                     float smoothing) const;

 private:
  LinearDiscriminant discriminant_;
};

}  // namespace panache
