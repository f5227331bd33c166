#pragma once
// Penalises joints bent beyond human limits during training.

#include <torch/types.h>

namespace panache {

// Excess of torso, head, shoulders, elbows, hips and knees of `out` over their range of motion
// (rig/range_of_motion.h), as far as it is larger than that of `in`: the Anatomy stage of the live
// step would undo it. Squares in units of 10 degrees with linear tails, so that no row dominates;
// summed over joints, averaged over rows.
// Canonical bodies at any position and heading. [rows][21][3]
torch::Tensor anatomy_loss(const torch::Tensor& in, const torch::Tensor& out);

}  // namespace panache
