#pragma once
// Weights in int8 as the libraries of others take them.

#include <cstdint>
#include <vector>

#include "bench/networks.h"

namespace panache::bench {

// Weights rounded to int8, -127 to 127, and what one of them is worth in each column, as quantize()
// does with layers that are not small.
struct Int8Layer {
  std::vector<int8_t> weights;  // [inputs][outputs]
  std::vector<float> scale;     // [outputs]
};
Int8Layer quantized(const Layer& layer);

}  // namespace panache::bench
