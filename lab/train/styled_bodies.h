#pragma once
// Differentiable restyling of bodies, and what training penalises in them.

#include <torch/types.h>

#include "learn/samples.h"
#include "rig/humanoid.h"
#include "train/batches.h"

namespace panache {

inline constexpr int kHipsHeight = 3 * kHumanJoints;  // Index in a packed StyleDelta.

// Applies changes to bodies, with gradients: the change_body() of training.
// bodies[rows][21][3], changes[rows][StyleDelta::kSize] -> [rows][21][3]
torch::Tensor styled_bodies(const torch::Tensor& bodies, const torch::Tensor& changes);

// Speed that a change gives to toes planted in the input, in units of 0.2 m/s: squares with linear
// tails, so that no sequence dominates; averaged over the planted toes. The live step's foot lock
// would hold such feet, and so remove what the style was recognised by. Root motion counts as far
// as the live step allows it: by the square of travel.
// in, out: canonical bodies in the body frame, kClassifiedSpacing frames apart.
// [sequences][instants][21][3]. root, root_change: velocity to the left and forward, m/s, and turn
// rate, radians/s, of the input, and the change to them. [sequences][instants][3].
torch::Tensor standing_loss(const torch::Tensor& in, const torch::Tensor& out,
                            const torch::Tensor& root, const torch::Tensor& root_change);

// Excess of torso, head, shoulders, elbows, hips and knees of `out` over their range of motion
// (rig/beyond_range.h), as far as it is larger than that of `in`: the Anatomy stage of the live
// step would undo it. Squares in units of 10 degrees with linear tails, so that no row dominates;
// summed over joints, averaged over rows.
// Canonical bodies at any position and heading. [rows][21][3]
torch::Tensor anatomy_loss(const torch::Tensor& in, const torch::Tensor& out);

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
