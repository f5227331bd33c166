#include "bench/int8_layer.h"

#include <algorithm>
#include <cmath>

namespace panache::bench {

Int8Layer quantized(const Layer& layer) {
  constexpr float kMaxWeight = 127;
  const size_t outputs = layer.bias.size();
  Int8Layer out{std::vector<int8_t>(layer.weights.size()), std::vector<float>(outputs)};
  for (size_t i = 0; i < layer.weights.size(); ++i) {
    float& scale = out.scale[i % outputs];
    scale = std::max(scale, std::abs(layer.weights[i]) / kMaxWeight);
  }
  for (size_t i = 0; i < layer.weights.size(); ++i) {
    const float scale = out.scale[i % outputs];
    const float number = scale > 0 ? std::nearbyint(layer.weights[i] / scale) : 0.0f;
    out.weights[i] = static_cast<int8_t>(std::clamp(number, -kMaxWeight, kMaxWeight));
  }
  return out;
}

}  // namespace panache::bench
