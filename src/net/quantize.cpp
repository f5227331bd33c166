#include "net/quantize.h"

#include <algorithm>
#include <cmath>

#include "net/dense_int8.h"

namespace panache {

TensorFile quantize(const TensorFile& file) {
  const std::string suffix = ".weight";
  TensorFile out = file;
  for (const auto& [key, tensor] : file.tensors) {
    if (!key.ends_with(suffix) || tensor.int8 || tensor.shape.size() != 2) continue;
    const std::string prefix = key.substr(0, key.size() - suffix.size());
    const size_t inputs = static_cast<size_t>(tensor.shape[0]);
    const size_t outputs = static_cast<size_t>(tensor.shape[1]);
    if (!file.tensors.contains(prefix + ".bias")) continue;
    if (outputs < kPadding || inputs > kMaxInt8Inputs) continue;

    std::vector<float> scale(outputs);
    for (size_t i = 0; i < tensor.values.size(); ++i) {
      float& s = scale[i % outputs];
      s = std::max(s, std::abs(tensor.values[i]) / kMaxInt8Weight);
    }
    Tensor& weights = out.tensors[key];
    weights.half = false;
    weights.int8 = true;
    for (size_t i = 0; i < tensor.values.size(); ++i) {
      const float s = scale[i % outputs];
      const float number = s > 0 ? std::nearbyint(tensor.values[i] / s) : 0.0f;
      weights.values[i] = std::clamp(number, float(-kMaxInt8Weight), float(kMaxInt8Weight));
    }
    out.tensors[prefix + ".scale"] = {{tensor.shape[1]}, std::move(scale), false, false};
  }
  return out;
}

bool is_quantized(const TensorFile& file) {
  return std::any_of(file.tensors.begin(), file.tensors.end(),
                     [](const auto& tensor) { return tensor.second.int8; });
}

}  // namespace panache
