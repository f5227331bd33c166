#pragma once
// Networks as the bytes of an ONNX model.

#include <span>
#include <string>

#include "bench/networks.h"

namespace panache::bench {

// Input "x" [1][inputs], outputs "y0", "y1", ... [1][outputs] of each network; Gemm and Elu nodes.
std::string format_onnx(std::span<const Network> networks);

}  // namespace panache::bench
