#include "net/mlp.h"

#include <algorithm>
#include <cassert>
#include <numeric>

#include "net/dense.h"
#include "net/dense_int8.h"

namespace panache {
Result<std::vector<float>> read_vector(const TensorFile& file, const std::string& key, int size,
                                       const std::string& name) {
  const Result<const Tensor*> tensor = find_tensor(file, key, {size}, name);
  if (!tensor) return tensor.error();
  return (*tensor)->values;
}

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
  if (!(*weights)->int8) return layer;

  Result<const Tensor*> scale = find_tensor(file, prefix + ".scale", {layer.outputs}, name);
  if (!scale) return scale.error();
  layer.scale = (*scale)->values;
  const std::string where = name + ": tensor '" + prefix + ".weight' ";
  if (static_cast<size_t>(layer.inputs) > kMaxInt8Inputs) {
    return Error{where + "of bytes has " + std::to_string(layer.inputs) +
                 " inputs; expected at most " + std::to_string(kMaxInt8Inputs)};
  }
  for (size_t i = 0; i < layer.weights.size(); ++i) {
    if (layer.weights[i] < -kMaxInt8Weight) {
      return Error{where + "holds a -128 (number " + std::to_string(i) + "); expected bytes from " +
                   std::to_string(-kMaxInt8Weight) + " to " + std::to_string(kMaxInt8Weight)};
    }
    layer.int8_weights.push_back(static_cast<int8_t>(layer.weights[i]));
    layer.weights[i] *= layer.scale[i % static_cast<size_t>(layer.outputs)];
  }
  return layer;
}

Result<Trunk> Trunk::read(const TensorFile& file, const std::string& prefix, int inputs,
                          const std::string& name) {
  Trunk trunk;
  const auto key = [&](size_t layer) { return prefix + "." + std::to_string(layer); };
  const auto has = [&](size_t layer) { return file.tensors.contains(key(layer) + ".weight"); };
  size_t expected = 0;  // Tensors.
  do {
    Result<DenseLayer> layer = read_layer(file, key(trunk.plain_.size()), inputs, -1, name);
    if (!layer) return layer.error();
    inputs = layer->outputs;
    expected += layer->int8_weights.empty() ? 2 : 3;
    trunk.layers_.emplace_back(*layer);
    trunk.plain_.push_back(*std::move(layer));
  } while (has(trunk.layers_.size()));
  // A layer after a gap would be ignored silently.
  const std::string start = prefix + ".";
  size_t found = 0;
  for (auto it = file.tensors.lower_bound(start);
       it != file.tensors.end() && it->first.starts_with(start); ++it) {
    ++found;
  }
  if (found != expected) {
    return Error{name + ": has " + std::to_string(found) + " tensors '" + start + "*'; expected " +
                 std::to_string(expected) + ", a weight and a bias for each of the layers from " +
                 key(0) + " to " + key(trunk.layers_.size() - 1)};
  }
  return trunk;
}

Trunk Trunk::none(int inputs) {
  DenseLayer layer;
  layer.inputs = inputs;
  Trunk trunk;
  trunk.layers_.emplace_back(layer);
  trunk.plain_.push_back(std::move(layer));
  return trunk;
}

int Trunk::inputs() const { return plain_.empty() ? 0 : plain_.front().inputs; }
int Trunk::outputs() const { return plain_.empty() ? 0 : plain_.back().outputs; }
bool Trunk::is_int8() const { return !plain_.empty() && !plain_.front().int8_weights.empty(); }

int Trunk::widest() const {
  int widest = 0;
  for (const DenseLayer& layer : plain_) widest = std::max(widest, layer.outputs);
  return widest;
}

size_t Trunk::trunk_scratch_size(size_t rows) const {
  size_t width = 0;
  for (const PackedLayer& layer : layers_) width += layer.width();
  return rows * width;
}

Rows<const float> Trunk::forward(const Rows<const float>& x,
                                 std::span<float> scratch) const noexcept {
  assert(scratch.size() >= trunk_scratch_size(x.count));
  // Layer by layer, each with all rows; the outputs of each stay for all_layers().
  float* to = scratch.data();
  const float* from = x.first;
  size_t stride = x.stride;
  for (const PackedLayer& layer : layers_) {
    const size_t numbers = x.count * layer.width();
    layer.forward({from, x.count, stride}, {to, x.count, layer.width()});
    elu({to, numbers});
    from = to;
    stride = layer.width();
    to += numbers;
  }
  return {from, x.count, stride};
}

std::span<const float> Trunk::forward(std::span<const float> x,
                                      std::span<float> scratch) const noexcept {
  assert(layers_.empty() || x.size() == static_cast<size_t>(inputs()));
  const size_t outputs = layers_.empty() ? x.size() : static_cast<size_t>(this->outputs());
  return {forward(Rows<const float>{x.data(), 1, 0}, scratch).first, outputs};
}

TrunkTrio::TrunkTrio(std::array<Trunk, kTrunks> trunks) : rest_(std::move(trunks)) {
  assert(std::all_of(rest_.begin(), rest_.end(),
                     [this](const Trunk& trunk) { return trunk.inputs() == rest_[0].inputs(); }));
  std::vector<DenseLayer> first;
  for (size_t t = 0; t < kTrunks; ++t) {
    for (const DenseLayer& layer : rest_[t].plain_) {
      outputs_[t].push_back(static_cast<size_t>(layer.outputs));
    }
    first.push_back(std::move(rest_[t].plain_.front()));
    rest_[t].plain_.clear();
    rest_[t].layers_.erase(rest_[t].layers_.begin());
  }
  first_ = PackedLayer(first);
}

size_t TrunkTrio::scratch_size(size_t rows) const {
  size_t size = rows * first_.width();
  for (const Trunk& trunk : rest_) size += trunk.trunk_scratch_size(rows);
  return size;
}

std::array<std::span<const float>, TrunkTrio::kTrunks> TrunkTrio::forward(
    std::span<const float> x, std::span<float> scratch) const noexcept {
  assert(x.size() == static_cast<size_t>(inputs()));
  const auto rows = forward(Rows<const float>{x.data(), 1, 0}, scratch);
  std::array<std::span<const float>, kTrunks> out;
  for (size_t t = 0; t < kTrunks; ++t) {
    out[t] = {rows[t].first, outputs_[t].back()};
  }
  return out;
}

std::array<Rows<const float>, TrunkTrio::kTrunks> TrunkTrio::forward(
    const Rows<const float>& x, std::span<float> scratch) const noexcept {
  assert(scratch.size() >= scratch_size(x.count));
  const Rows<float> hidden{scratch.data(), x.count, first_.width()};
  scratch = scratch.subspan(x.count * first_.width());
  first_.forward(x, hidden);
  elu({hidden.first, x.count * first_.width()});
  std::array<Rows<const float>, kTrunks> out;
  for (size_t t = 0; t < kTrunks; ++t) {
    out[t] = rest_[t].forward(Rows<const float>(hidden.from(first_.begin(t))), scratch);
    scratch = scratch.subspan(rest_[t].trunk_scratch_size(x.count));
  }
  return out;
}

size_t TrunkTrio::all_outputs(size_t trunk) const {
  return std::accumulate(outputs_[trunk].begin(), outputs_[trunk].end(), size_t{0});
}

void TrunkTrio::all_layers(size_t trunk, size_t row, size_t rows, std::span<const float> scratch,
                           std::span<float> out) const noexcept {
  assert(row < rows && scratch.size() >= scratch_size(rows) && out.size() == all_outputs(trunk));
  const std::vector<size_t>& outputs = outputs_[trunk];
  const float* from = scratch.data();
  float* to =
      std::copy_n(from + row * first_.width() + first_.begin(trunk), outputs[0], out.data());
  from += rows * first_.width();
  for (size_t t = 0; t < trunk; ++t) from += rest_[t].trunk_scratch_size(rows);
  for (size_t l = 1; l < outputs.size(); ++l) {
    const size_t width = rest_[trunk].layers_[l - 1].width();
    to = std::copy_n(from + row * width, outputs[l], to);
    from += rows * width;
  }
}

}  // namespace panache
