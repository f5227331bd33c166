#pragma once
// Bodies as tensors, for tests of losses.

#include <torch/types.h>

#include "rig/humanoid.h"

namespace panache::test {

inline torch::Tensor as_tensor(const HumanPositions& body) {  // [21][3]
  torch::Tensor tensor = torch::empty({kHumanJoints, 3});
  for (int j = 0; j < kHumanJoints; ++j) {
    tensor[j] = torch::tensor({body[j].x, body[j].y, body[j].z});
  }
  return tensor;
}

}  // namespace panache::test
