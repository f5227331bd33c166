#include <algorithm>
#include <cassert>
#include <cmath>

#include "net/dense.h"
#include "style/model.h"

namespace panache {
namespace {

// Beyond strength 1 the heads are driven this share as fast: at twice its size a style's change
// tears the motion apart, and the upper half of the slider would be of no use.
constexpr float kExaggeration = 0.3f;

float head_strength(float strength) {
  const float size = std::abs(strength);
  return size <= 1 ? strength : std::copysign(1 + kExaggeration * (size - 1), strength);
}

}  // namespace

StyleNetworks::StyleNetworks(std::shared_ptr<const Model> model) : model_(std::move(model)) {
  const Model& m = *model_;
  strengths_.assign(m.styles_.size(), 0.0f);
  input_.assign(m.pose_.trunk.inputs(), 0.0f);
  scratch_.resize(std::max({m.pose_.trunk.scratch_size(), m.timing_.trunk.scratch_size(),
                            m.contact_.trunk.scratch_size()}));
  const struct {
    const Model::Network* network;
    Mixed* mixed;
    std::vector<float>* out;
  } parts[] = {{&m.pose_, &pose_, &pose_out_},
               {&m.timing_, &timing_, &timing_out_},
               {&m.contact_, &contact_, &contact_out_}};
  for (const auto& [network, mixed, out] : parts) {
    const DenseLayer& head = network->heads.front();
    mixed->weights = head.weights;
    mixed->bias = head.bias;
    out->assign(head.outputs, 0.0f);
  }
  features_.resize(m.pose_.trunk.outputs());
  centred_.resize(features_.size());
  white_.resize(m.gate_.whitening.outputs);
  no_bias_.assign(white_.size(), 0.0f);
}

void StyleNetworks::mix(const Model::Network& network, bool has_base, Mixed& mixed) noexcept {
  std::fill(mixed.weights.begin(), mixed.weights.end(), 0.0f);
  std::fill(mixed.bias.begin(), mixed.bias.end(), 0.0f);
  for (size_t h = 0; h < network.heads.size(); ++h) {
    const bool base = has_base && h == 0;
    const float strength = base ? 1.0f : head_strength(strengths_[has_base ? h - 1 : h]);
    if (strength == 0) continue;
    add_scaled(strength, network.heads[h].weights, mixed.weights);
    add_scaled(strength, network.heads[h].bias, mixed.bias);
  }
}

void StyleNetworks::set_strengths(std::span<const float> strengths) noexcept {
  assert(strengths.size() == strengths_.size());
  if (mixed_ && std::equal(strengths.begin(), strengths.end(), strengths_.begin())) return;
  std::copy(strengths.begin(), strengths.end(), strengths_.begin());
  mixed_ = true;
  if (model_->recipe_ == Recipe::panache) {
    mix(model_->pose_, false, pose_);
    mix(model_->timing_, false, timing_);
    mix(model_->contact_, true, contact_);
    return;
  }
  // The style vector: first neutral, which gets what the styles leave of 1, then the styles.
  float neutral = 1;
  for (const float s : strengths_) neutral -= s;
  float* style = input_.data() + input_.size() - strengths_.size() - 1;
  style[0] = std::max(neutral, 0.0f);
  std::copy(strengths_.begin(), strengths_.end(), style + 1);
}

void StyleNetworks::run(const Model::Network& network, const Mixed& mixed,
                        std::span<float> out) noexcept {
  const std::span<const float> hidden = network.trunk.forward(input_, scratch_);
  dense(hidden, mixed.weights, mixed.bias, out);
}

void StyleNetworks::shrink(std::span<const float> hidden, float gate_share) noexcept {
  const Model::Gate& gate = model_->gate_;
  std::copy(hidden.begin(), hidden.end(), features_.begin());
  if (!gate.present()) return;
  for (size_t i = 0; i < centred_.size(); ++i) centred_[i] = features_[i] - gate.mean[i];
  dense(centred_, gate.whitening.weights, no_bias_, white_);
  float square = 0;
  for (const float w : white_) square += w * w;
  const float limit = gate.limit * gate.limit;
  const float near = square > limit ? limit / square : 1.0f;
  const float wanted = near * near;  // Falls with the fourth power of the distance.
  if (std::isfinite(wanted)) gate_ += gate_share * (wanted - gate_);
  if (gate_ == 1) return;
  for (size_t i = 0; i < centred_.size(); ++i) features_[i] = gate.mean[i] + gate_ * centred_[i];
}

void StyleNetworks::forward(std::span<const float> window, float gate_share) noexcept {
  const Model& m = *model_;
  const size_t numbers = m.input_mean_.size();
  assert(window.size() == numbers * kWindowPoses);
  const float clip = m.input_clip_ > 0 ? m.input_clip_ : INFINITY;
  for (size_t i = 0; i < window.size(); ++i) {
    const size_t n = i % numbers;
    input_[i] = std::clamp((window[i] - m.input_mean_[n]) / m.input_scale_[n], -clip, clip);
  }
  shrink(m.pose_.trunk.forward(input_, scratch_), gate_share);
  dense(features_, pose_.weights, pose_.bias, pose_out_);
  run(m.timing_, timing_, timing_out_);
  run(m.contact_, contact_, contact_out_);
  for (size_t i = 0; i < pose_out_.size(); ++i) {
    pose_out_[i] = pose_out_[i] * m.output_scale_[i] + m.output_mean_[i];
  }
  for (float& c : contact_out_) c = 1 / (1 + std::exp(-c));
}

}  // namespace panache
