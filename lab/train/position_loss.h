#pragma once
// How well the pose network puts the joints where the pairs show them.

#include <torch/types.h>

#include "learn/samples.h"
#include "train/batches.h"

namespace panache {

// The squared error of a change weighs all rotations alike. Where a joint ends depends on all
// rotations between it and the hips: a raised hand on five, a toe on four. Changes are therefore
// compared by what they make of the window's own body, too.
class PositionLoss {
 public:
  // Of recipes with layout positions that answer with a packed StyleDelta without a mean.
  PositionLoss(const SampleSet& set, const OutputUnits& units);

  // Square of the distance of the joints, in units of 10 cm, mean over joints and rows. `answers`
  // and `batch.pose` in output units, [rows][StyleDelta::kSize].
  torch::Tensor operator()(const torch::Tensor& answers, const Batch& batch) const;

 private:
  torch::Tensor input_mean_, input_scale_;  // Of the body of now. [21 * 3]
  torch::Tensor output_scale_;              // [StyleDelta::kSize]
};

}  // namespace panache
