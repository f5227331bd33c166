#pragma once
// int8 weights in the form that other libraries expect.

#include <cstdint>
#include <vector>

#include "bench/networks.h"

namespace panache::bench {

// Weights rounded to int8, -127 to 127, with one scale per column, as quantize() does for all but
// small layers.
struct Int8Layer {
  std::vector<int8_t> weights;  // [inputs][outputs]
  std::vector<float> scale;     // [outputs]
};
Int8Layer quantized(const Layer& layer);

}  // namespace panache::bench
