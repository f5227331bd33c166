#pragma once
// The error of the pose network as joint positions.

#include <torch/types.h>

#include "learn/samples.h"
#include "train/batches.h"

namespace panache {

// The squared error of a change weighs all rotations alike. But a joint's position depends on all
// rotations between it and the hips: a raised hand on five, a toe on four. So changes are also
// compared by their effect on the window's own body.
class PositionLoss {
 public:
  // For recipes with layout positions that output a packed StyleDelta without a mean.
  PositionLoss(const SampleSet& set, const OutputUnits& units);

  // Squared distance of the joints in units of 10 cm, averaged over joints and rows. `answers` and
  // `batch.pose` in output units, [rows][StyleDelta::kSize].
  torch::Tensor operator()(const torch::Tensor& answers, const Batch& batch) const;

 private:
  torch::Tensor input_mean_, input_scale_;  // Of the current pose. [21 * 3]
  torch::Tensor output_scale_;              // [StyleDelta::kSize]
};

}  // namespace panache
