#pragma once
// Layers with int8 weights: a quarter of the memory that each step reads.

#include "net/safetensors.h"

namespace panache {

// The file with the weights of its dense layers (every matrix `X.weight` that has a bias `X.bias`)
// rounded to int8; `X.scale` holds the scale of each column.
// Layers of fewer than kPadding outputs, which weigh nothing, and those of more inputs than
// kMaxInt8Inputs stay as they are, as does everything else. Any trunk of the result is read and
// evaluated as before: Trunk and TrunkTrio see what its layers are made of. Weights are finite.
TensorFile quantize(const TensorFile& file);

// Whether some of the file's tensors are bytes.
bool is_quantized(const TensorFile& file);

}  // namespace panache
