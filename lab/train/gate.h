#pragma once
// What motion a trained pose network knows: the ellipsoid that its activations fill in training.

#include <torch/types.h>

#include "net/safetensors.h"

namespace panache {

// Adds gate.mean, gate.whitening and gate.limit to a model: mean and covariance of the pose trunk's
// activations over training windows, and the distance beyond which windows are trusted less and
// less: `trusted` times the one that 99 % of the training windows keep. activations[rows][hidden].
inline constexpr double kTrusted = 0.61;
// Styled motion is less alike than neutral motion: with kTrusted, a remover leaves a part of the
// style in takes that it could make neutral.
inline constexpr double kTrustedByRemovers = 1.83;
void fit_gate(const torch::Tensor& activations, TensorFile& file, double trusted = kTrusted);

}  // namespace panache
