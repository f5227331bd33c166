#include "net/layer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "net/dense.h"
#include "net/dense_int8.h"

namespace panache {

DenseLayer side_by_side(std::span<const DenseLayer> layers) {
  DenseLayer out;
  out.inputs = layers.front().inputs;
  for (const DenseLayer& layer : layers) {
    assert(layer.inputs == out.inputs);
    out.outputs += layer.outputs;
    out.bias.insert(out.bias.end(), layer.bias.begin(), layer.bias.end());
  }
  for (int i = 0; i < out.inputs; ++i) {
    for (const DenseLayer& layer : layers) {
      const auto row = layer.weights.begin() + static_cast<ptrdiff_t>(i) * layer.outputs;
      out.weights.insert(out.weights.end(), row, row + layer.outputs);
    }
  }
  return out;
}

PackedLayer::PackedLayer(std::span<const DenseLayer> layers) {
  size_t width = 0;
  for (const DenseLayer& layer : layers) {
    begins_.push_back(width);
    width += padded(static_cast<size_t>(layer.outputs));
  }
  inputs_ = static_cast<size_t>(layers.front().inputs);
  const bool is_int8 = std::all_of(layers.begin(), layers.end(), [](const DenseLayer& layer) {
    return layer.outputs == 0 || !layer.int8_weights.empty();
  });
  bias_.resize(width);
  if (is_int8) {
    scale_.resize(width);
    int8_.assign((inputs_ + 1) / 2 * width + kInt8Slack, packed_weights(0, 0));
  } else {
    weights_.resize(inputs_ * width);
  }
  for (size_t l = 0; l < layers.size(); ++l) {
    const DenseLayer& layer = layers[l];
    assert(static_cast<size_t>(layer.inputs) == inputs_);
    const size_t outputs = static_cast<size_t>(layer.outputs);
    std::copy(layer.bias.begin(), layer.bias.end(), bias_.begin() + begins_[l]);
    if (is_int8) std::copy(layer.scale.begin(), layer.scale.end(), scale_.begin() + begins_[l]);
    for (size_t i = 0; i < inputs_; ++i) {
      for (size_t o = 0; o < outputs; ++o) {
        const size_t from = i * outputs + o, to = begins_[l] + o;
        if (is_int8) {
          set_int8_weight(int8_.data(), width, i, to, layer.int8_weights[from]);
        } else {
          weights_[i * width + to] = layer.weights[from];
        }
      }
    }
  }
}

void PackedLayer::forward(const Rows<const float>& x, const Rows<float>& y) const noexcept {
  if (int8_.empty()) {
    dense_rows(x, inputs_, weights_, bias_, y);
  } else {
    dense_int8(x, {inputs_, width(), int8_.data(), scale_.data(), bias_.data()}, y);
  }
}

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
