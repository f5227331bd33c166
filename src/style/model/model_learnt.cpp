// Reads the parts of styles besides trained heads: styles learnt in closed form, and gestures.

#include <cmath>

#include "style/model/model.h"

namespace panache {
namespace {

// Prefix of a learnt style's tensors.
std::string learnt_prefix(size_t learnt) { return "learnt." + std::to_string(learnt) + "."; }
// Prefix of a style's gestures. `index`: among the styles of its kind.
std::string gesture_prefix(bool learnt, size_t index) {
  return learnt ? learnt_prefix(index) + "gesture." : "gesture." + std::to_string(index) + ".";
}

}  // namespace

size_t Model::count_learnt(const TensorFile& file) {
  size_t count = 0;
  while (file.tensors.contains(learnt_prefix(count) + "head.weight")) ++count;
  return count;
}

Result<void> Model::read_activations(const TensorFile& file, const std::string& name) {
  if (!file.tensors.contains("learn.mean") && !file.tensors.contains("learn.scale")) return {};
  const int activations = static_cast<int>(activation_count());
  Result<std::vector<float>> mean = read_vector(file, "learn.mean", activations, name);
  if (!mean) return mean.error();
  Result<std::vector<float>> scale = read_vector(file, "learn.scale", activations, name);
  if (!scale) return scale.error();
  for (const float s : *scale) {
    if (!(s > 0) || std::isinf(1 / s)) {
      return Error{name + ": tensor 'learn.scale' must be above zero throughout"};
    }
    activation_factor_.push_back(1 / s);
  }
  activation_mean_ = *std::move(mean);
  activation_scale_ = *std::move(scale);
  return {};
}

Result<void> Model::read_learnt(const TensorFile& file, size_t count, const std::string& name) {
  for (size_t k = 0; k < count; ++k) {
    Result<Learnt> style = read_one_learnt(file, learnt_prefix(k), name);
    if (!style) return style.error();
    learnt_.push_back(*std::move(style));
    styles_[styles_.size() - count + k].learnt = true;
  }
  return {};
}

Result<Model::Learnt> Model::read_one_learnt(const TensorFile& file, const std::string& prefix,
                                             const std::string& name) const {
  if (!can_learn()) {
    return Error{name + ": has tensors '" + prefix +
                     "*' of a learnt style, but no 'learn.mean' and 'learn.scale'",
                 ErrorKind::model_cannot_learn};
  }
  const int activations = static_cast<int>(activation_count());
  Learnt learnt;
  Result<DenseLayer> head = read_layer(file, prefix + "head", activations, kLearntOutputs, name);
  if (!head) return head.error();
  learnt.head = PackedLayer(*head);
  Result<std::vector<float>> mean = read_vector(file, prefix + "mean", activations, name);
  if (!mean) return mean.error();
  learnt.mean = *std::move(mean);
  Result<DenseLayer> gate = read_layer(file, prefix + "gate", activations, -1, name);
  if (!gate) return gate.error();
  if (gate->outputs > activations) {
    return Error{name + ": tensor '" + prefix + "gate.weight' has " +
                 std::to_string(gate->outputs) + " directions; expected at most " +
                 std::to_string(activations)};
  }
  learnt.gate = PackedLayer(*gate);
  Result<std::vector<float>> gate_weights =
      read_vector(file, prefix + "gate.worth", gate->outputs, name);
  if (!gate_weights) return gate_weights.error();
  learnt.gate_weights = *std::move(gate_weights);
  Result<std::vector<float>> rest = read_vector(file, prefix + "gate.rest", 1, name);
  if (!rest) return rest.error();
  learnt.gate_residual = rest->front();
  return learnt;
}

Result<void> Model::read_gestures(const TensorFile& file, const std::string& name) {
  gestures_.resize(styles_.size());
  for (size_t style = 0; style < styles_.size(); ++style) {
    const bool learnt = style >= built_in();
    const std::string prefix = gesture_prefix(learnt, learnt ? style - built_in() : style);
    for (int k = 0; k < kMaxGestures; ++k) {
      const std::string key = prefix + std::to_string(k);
      const auto found = file.tensors.find(key);
      if (found == file.tensors.end()) break;
      Result<Gesture> gesture = Gesture::read(found->second, key, name);
      if (!gesture) return gesture.error();
      gestures_[style].push_back(*std::move(gesture));
    }
    name_gestures(gestures_[style]);
    if (gestures_[style].empty()) gesture_rates_[style] = 0;
  }
  return {};
}

}  // namespace panache
