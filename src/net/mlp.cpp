#include "net/mlp.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "net/dense.h"

namespace panache {
namespace {

std::string quoted_shape(const std::vector<int64_t>& shape) {
  std::string text = "[";
  for (const int64_t size : shape) {
    if (text.size() > 1) text += ", ";
    text += size < 0 ? "any" : std::to_string(size);
  }
  return text + "]";
}

// The tensor called `key`, if its shape is `expected` (-1 for any size above zero) and its numbers
// are finite.
Result<const Tensor*> find_tensor(const TensorFile& file, const std::string& key,
                                  const std::vector<int64_t>& expected, const std::string& name) {
  const auto found = file.tensors.find(key);
  if (found == file.tensors.end()) return Error{name + ": tensor '" + key + "' is missing"};
  const Tensor& tensor = found->second;
  bool fits = tensor.shape.size() == expected.size();
  for (size_t i = 0; fits && i < expected.size(); ++i) {
    const int64_t size = tensor.shape[i];
    fits =
        expected[i] < 0 ? size > 0 && size <= std::numeric_limits<int>::max() : size == expected[i];
  }
  if (!fits) {
    return Error{name + ": tensor '" + key + "' has shape " + quoted_shape(tensor.shape) +
                 "; expected " + quoted_shape(expected)};
  }
  const auto bad = std::find_if(tensor.values.begin(), tensor.values.end(),
                                [](float v) { return !std::isfinite(v); });
  if (bad != tensor.values.end()) {
    return Error{name + ": tensor '" + key + "' holds a number that is not finite (number " +
                 std::to_string(bad - tensor.values.begin()) + ")"};
  }
  return &tensor;
}

}  // namespace

Result<DenseLayer> read_layer(const TensorFile& file, const std::string& prefix, int inputs,
                              int outputs, const std::string& name) {
  Result<const Tensor*> weights = find_tensor(file, prefix + ".weight", {inputs, outputs}, name);
  if (!weights) return weights.error();
  DenseLayer layer;
  layer.inputs = static_cast<int>((*weights)->shape[0]);
  layer.outputs = static_cast<int>((*weights)->shape[1]);
  Result<const Tensor*> bias = find_tensor(file, prefix + ".bias", {layer.outputs}, name);
  if (!bias) return bias.error();
  layer.weights = (*weights)->values;
  layer.bias = (*bias)->values;
  return layer;
}

Result<Trunk> Trunk::read(const TensorFile& file, const std::string& prefix, int inputs,
                          const std::string& name) {
  Trunk trunk;
  const auto key = [&](size_t layer) { return prefix + "." + std::to_string(layer); };
  const auto has = [&](size_t layer) { return file.tensors.contains(key(layer) + ".weight"); };
  do {
    Result<DenseLayer> layer = read_layer(file, key(trunk.layers_.size()), inputs, -1, name);
    if (!layer) return layer.error();
    inputs = layer->outputs;
    trunk.layers_.push_back(*std::move(layer));
  } while (has(trunk.layers_.size()));
  // A layer behind a gap would be left out in silence.
  const std::string start = prefix + ".";
  size_t found = 0;
  for (auto it = file.tensors.lower_bound(start);
       it != file.tensors.end() && it->first.starts_with(start); ++it) {
    ++found;
  }
  if (found != 2 * trunk.layers_.size()) {
    const size_t expected = 2 * trunk.layers_.size();
    return Error{name + ": has " + std::to_string(found) + " tensors '" + start + "*'; expected " +
                 std::to_string(expected) + ", a weight and a bias for each of the layers from " +
                 key(0) + " to " + key(trunk.layers_.size() - 1)};
  }
  return trunk;
}

int Trunk::inputs() const { return layers_.empty() ? 0 : layers_.front().inputs; }
int Trunk::outputs() const { return layers_.empty() ? 0 : layers_.back().outputs; }

size_t Trunk::scratch_size() const {
  int widest = 0;
  for (const DenseLayer& layer : layers_) widest = std::max(widest, layer.outputs);
  return 2 * static_cast<size_t>(widest);
}

std::span<const float> Trunk::forward(std::span<const float> x,
                                      std::span<float> scratch) const noexcept {
  assert(layers_.empty() || x.size() == static_cast<size_t>(inputs()));
  assert(scratch.size() >= scratch_size());
  // The layers take turns between the two halves, as none may write where it reads.
  std::span<float> half = scratch.first(scratch_size() / 2);
  std::span<float> other = scratch.subspan(scratch_size() / 2);
  for (const DenseLayer& layer : layers_) {
    const std::span<float> y = half.first(layer.outputs);
    dense(x, layer.weights, layer.bias, y);
    elu(y);
    x = y;
    std::swap(half, other);
  }
  return x;
}

TrunkTrio::TrunkTrio(std::array<Trunk, kTrunks> trunks) : rest_(std::move(trunks)) {
  first_.inputs = rest_[0].inputs();
  for (size_t t = 0; t < kTrunks; ++t) {
    assert(rest_[t].inputs() == first_.inputs);
    outputs_[t] = rest_[t].outputs();
    widths_[t] = rest_[t].layers_.front().outputs;
    first_.outputs += widths_[t];
    const std::vector<float>& bias = rest_[t].layers_.front().bias;
    first_.bias.insert(first_.bias.end(), bias.begin(), bias.end());
  }
  first_.weights.reserve(static_cast<size_t>(first_.inputs) * first_.outputs);
  for (int i = 0; i < first_.inputs; ++i) {
    for (const Trunk& trunk : rest_) {
      const DenseLayer& layer = trunk.layers_.front();
      const auto row = layer.weights.begin() + static_cast<ptrdiff_t>(i) * layer.outputs;
      first_.weights.insert(first_.weights.end(), row, row + layer.outputs);
    }
  }
  for (Trunk& trunk : rest_) trunk.layers_.erase(trunk.layers_.begin());
}

size_t TrunkTrio::scratch_size() const {
  size_t size = static_cast<size_t>(first_.outputs);
  for (const Trunk& trunk : rest_) size += trunk.scratch_size();
  return size;
}

std::array<std::span<const float>, TrunkTrio::kTrunks> TrunkTrio::forward(
    std::span<const float> x, std::span<float> scratch) const noexcept {
  assert(x.size() == static_cast<size_t>(inputs()) && scratch.size() >= scratch_size());
  std::span<float> hidden = scratch.first(first_.outputs);
  scratch = scratch.subspan(hidden.size());
  dense(x, first_.weights, first_.bias, hidden);
  elu(hidden);
  std::array<std::span<const float>, kTrunks> out;
  for (size_t t = 0; t < kTrunks; ++t) {
    out[t] = rest_[t].forward(hidden.first(widths_[t]), scratch);
    hidden = hidden.subspan(widths_[t]);
    scratch = scratch.subspan(rest_[t].scratch_size());
  }
  return out;
}

}  // namespace panache
