#pragma once
// Penalises moving planted feet during training.

#include <torch/types.h>

namespace panache {

// Speed that a change gives to toes planted in the input, in units of 0.2 m/s: squares with linear
// tails, so that no sequence dominates; averaged over the planted toes. The live step's foot lock
// would hold such feet, and so remove what the style was recognised by. Root motion counts as far
// as the live step allows it: by the square of travel.
// in, out: canonical bodies in the body frame, kClassifiedSpacing frames apart.
// [sequences][instants][21][3]. root, root_change: velocity to the left and forward, m/s, and turn
// rate, radians/s, of the input, and the change to them. [sequences][instants][3].
torch::Tensor standing_loss(const torch::Tensor& in, const torch::Tensor& out,
                            const torch::Tensor& root, const torch::Tensor& root_change);

}  // namespace panache
