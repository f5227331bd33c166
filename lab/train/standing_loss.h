#pragma once
// What keeps training from moving feet that stand.

#include <torch/types.h>

namespace panache {

// How fast a change moves toes over the ground that stand on it in the input, in units of 0.2 m/s:
// squares that grow evenly further out, so that no sequence alone decides; mean over the toes that
// stand. The foot lock of the live step would hold such feet back, and with them whatever the style
// was recognised by. Root motion counts as far as the live step lets it: by the square of travel.
// in, out: canonical bodies in the body frame, kClassifiedSpacing frames apart.
// [sequences][instants][21][3]. root, root_change: velocity to the left and forward, m/s, and turn
// rate, radians/s, of the input, and what the change adds. [sequences][instants][3].
torch::Tensor standing_loss(const torch::Tensor& in, const torch::Tensor& out,
                            const torch::Tensor& root, const torch::Tensor& root_change);

}  // namespace panache
