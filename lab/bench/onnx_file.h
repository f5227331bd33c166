#pragma once
// Writes networks as an ONNX model.

#include <span>
#include <string>

#include "bench/networks.h"

namespace panache::bench {

// Input "x" [1][inputs], outputs "y0", "y1", ... [1][outputs] of each network; Gemm and Elu nodes.
// `int8`: weights in int8 (Int8Layer) and dynamic quantization of each layer's input to 8 bits:
// DynamicQuantizeLinear, MatMulInteger, Cast, Mul, Mul, Add.
std::string format_onnx(std::span<const Network> networks, bool int8 = false);

}  // namespace panache::bench
