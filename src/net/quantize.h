#pragma once
// Layers with int8 weights: a quarter of the memory that each step reads.

#include "net/safetensors.h"

namespace panache {

// Quantizes the weights of all dense layers (every matrix `X.weight` with a bias `X.bias`) to int8;
// `X.scale` holds the scale of each column. Small layers with fewer than kPadding outputs, and
// those with more than kMaxInt8Inputs inputs, stay as they are, as does everything else. Trunk and
// TrunkTrio read and evaluate the result as before. Weights must be finite.
TensorFile quantize(const TensorFile& file);

// Whether any of the file's tensors is int8.
bool is_quantized(const TensorFile& file);

}  // namespace panache
