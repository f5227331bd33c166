#include "net/half_size.h"

#include <algorithm>
#include <cmath>

#include "net/dense_bytes.h"

namespace panache {

TensorFile in_half_size(const TensorFile& file) {
  const std::string ending = ".weight";
  TensorFile out = file;
  for (const auto& [key, tensor] : file.tensors) {
    if (!key.ends_with(ending) || tensor.bytes || tensor.shape.size() != 2) continue;
    const std::string prefix = key.substr(0, key.size() - ending.size());
    const size_t inputs = static_cast<size_t>(tensor.shape[0]);
    const size_t outputs = static_cast<size_t>(tensor.shape[1]);
    if (!file.tensors.contains(prefix + ".bias")) continue;
    if (outputs < kPadding || inputs > kMaxByteInputs) continue;

    std::vector<float> scale(outputs);
    for (size_t i = 0; i < tensor.values.size(); ++i) {
      float& s = scale[i % outputs];
      s = std::max(s, std::abs(tensor.values[i]) / kLargestByte);
    }
    Tensor& weights = out.tensors[key];
    weights.half = false;
    weights.bytes = true;
    for (size_t i = 0; i < tensor.values.size(); ++i) {
      const float s = scale[i % outputs];
      const float number = s > 0 ? std::nearbyint(tensor.values[i] / s) : 0.0f;
      weights.values[i] = std::clamp(number, float(-kLargestByte), float(kLargestByte));
    }
    out.tensors[prefix + ".scale"] = {{tensor.shape[1]}, std::move(scale), false, false};
  }
  return out;
}

bool is_half_size(const TensorFile& file) {
  return std::any_of(file.tensors.begin(), file.tensors.end(),
                     [](const auto& tensor) { return tensor.second.bytes; });
}

}  // namespace panache
