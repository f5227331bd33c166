#pragma once
// Fits the gate: an ellipsoid around the pose network's activations on training data.

#include <torch/types.h>

#include "net/safetensors.h"

namespace panache {

// Adds gate.mean, gate.whitening and gate.limit to a model: mean and covariance of the pose trunk's
// activations on training windows, and the distance beyond which the gate closes gradually:
// `trusted` times that which 99 % of the windows are within. activations[rows][hidden].
inline constexpr double kTrusted = 0.61;
// Styled motion varies more than neutral motion: with kTrusted, a remover would leave part of the
// style in takes that it can make neutral.
inline constexpr double kTrustedByRemovers = 1.83;
void fit_gate(const torch::Tensor& activations, TensorFile& file, double trusted = kTrusted);

}  // namespace panache
