#pragma once
// Bodies in styles, with gradients.

#include <torch/types.h>

#include "rig/humanoid.h"

namespace panache {

inline constexpr int kHipsHeight = 3 * kHumanJoints;  // Its place in a packed StyleDelta.

// What bodies become by changes, with gradients: the change_body() of training.
// bodies[rows][21][3], changes[rows][StyleDelta::kSize] -> [rows][21][3]
torch::Tensor styled_bodies(const torch::Tensor& bodies, const torch::Tensor& changes);

}  // namespace panache
