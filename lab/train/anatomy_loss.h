#pragma once
// What keeps training from bending joints as no human joint bends.

#include <torch/types.h>

namespace panache {

// How far torso, head, shoulders, elbows, hips and knees of `out` leave their range of motion
// (rig/range_of_motion.h), and go further than those of `in`: the stage Anatomy of the live step
// would take it back. Squares of 10 degrees, which grow evenly further out, so that no row alone
// decides; summed over the joints, mean over the rows.
// Canonical bodies of any place and heading. [rows][21][3]
torch::Tensor anatomy_loss(const torch::Tensor& in, const torch::Tensor& out);

}  // namespace panache
