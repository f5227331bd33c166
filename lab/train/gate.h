#pragma once
// What motion a trained pose network knows: the ellipsoid that its activations fill in training.

#include <torch/types.h>

#include "net/safetensors.h"

namespace panache {

// Adds gate.mean, gate.whitening and gate.limit to a model: mean and covariance of the pose trunk's
// activations over training windows, and the distance beyond which windows are trusted less and
// less. activations[rows][hidden].
void fit_gate(const torch::Tensor& activations, TensorFile& file);

}  // namespace panache
