#pragma once
// Differentiable restyling of bodies.

#include <torch/types.h>

#include "rig/humanoid.h"

namespace panache {

inline constexpr int kHipsHeight = 3 * kHumanJoints;  // Index in a packed StyleDelta.

// Applies changes to bodies, with gradients: the change_body() of training.
// bodies[rows][21][3], changes[rows][StyleDelta::kSize] -> [rows][21][3]
torch::Tensor styled_bodies(const torch::Tensor& bodies, const torch::Tensor& changes);

}  // namespace panache
