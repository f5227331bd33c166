#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/elementary.h"
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

StyleNetworks::StyleNetworks(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      strengths_(model_->styles_.size()),
      pose_out_(model_->output_scale_.size()) {}

void StyleNetworks::set_strengths(std::span<const float> strengths) noexcept {
  assert(strengths.size() == strengths_.size());
  std::copy(strengths.begin(), strengths.end(), strengths_.begin());
}

void StyleNetworks::add_heads(int network, std::span<const float> hidden,
                              std::span<float> out) const noexcept {
  const Model::Heads& heads = model_->heads_[network];
  // Heads that are in force whatever the styles: the only one (smith2019), or that of no style.
  const size_t always = heads.size() > strengths_.size() || model_->recipe_ == Recipe::smith2019;
  std::array<float, Model::kMaxOutputs> answer;
  const std::span<float> part = std::span(answer).first(out.size());
  std::fill(out.begin(), out.end(), 0.0f);
  for (size_t h = 0; h < heads.size(); ++h) {
    const float strength = h < always ? 1.0f : head_strength(strengths_[h - always]);
    if (strength == 0) continue;
    dense(hidden, heads[h].weights, heads[h].bias, part);
    add_scaled(strength, part, out);
  }
}

void StyleNetworks::shrink(std::span<const float> hidden, float gate_share,
                           std::span<float> features) noexcept {
  const Model::Gate& gate = model_->gate_;
  std::copy(hidden.begin(), hidden.end(), features.begin());
  if (!gate.present()) return;
  std::array<float, Model::kMaxUnits> centred, white;
  for (size_t i = 0; i < features.size(); ++i) centred[i] = features[i] - gate.mean[i];
  const std::span<float> out = std::span(white).first(gate.whitening.outputs);
  dense(std::span(centred).first(features.size()), gate.whitening.weights, gate.whitening.bias,
        out);
  float square = 0;
  for (const float w : out) square += w * w;
  const float limit = gate.limit * gate.limit;
  const float near = square > limit ? limit / square : 1.0f;
  const float wanted = near * near;  // Falls with the fourth power of the distance.
  if (std::isfinite(wanted)) gate_ += gate_share * (wanted - gate_);
  if (gate_ == 1) return;
  for (size_t i = 0; i < features.size(); ++i) features[i] = gate.mean[i] + gate_ * centred[i];
}

void StyleNetworks::forward(std::span<const float> window, float gate_share) noexcept {
  const Model& m = *model_;
  const size_t numbers = m.input_mean_.size();
  assert(window.size() == numbers * kWindowPoses);
  std::array<float, Model::kMaxInputs> inputs;
  std::array<float, Model::kMaxScratch> scratch;
  const std::span<float> input = std::span(inputs).first(m.trunks_.inputs());
  const float clip = m.input_clip_ > 0 ? m.input_clip_ : INFINITY;
  for (size_t k = 0; k < size_t(kWindowPoses); ++k) {
    const float* pose = window.data() + k * numbers;
    float* to = input.data() + k * numbers;
    for (size_t n = 0; n < numbers; ++n) {
      to[n] = std::clamp((pose[n] - m.input_mean_[n]) / m.input_scale_[n], -clip, clip);
    }
  }
  if (m.recipe_ == Recipe::smith2019) {
    // The style vector: first neutral, which gets what the styles leave of 1, then the styles.
    float neutral = 1;
    for (const float s : strengths_) neutral -= s;
    float* style = input.data() + window.size();
    style[0] = std::max(neutral, 0.0f);
    std::copy(strengths_.begin(), strengths_.end(), style + 1);
  }
  const auto hidden = m.trunks_.forward(input, scratch);
  std::array<float, Model::kMaxUnits> features;
  const std::span<float> pose_features = std::span(features).first(hidden[Model::kPose].size());
  shrink(hidden[Model::kPose], gate_share, pose_features);
  add_heads(Model::kPose, pose_features, pose_out_);
  add_heads(Model::kTiming, hidden[Model::kTiming], timing_out_);
  add_heads(Model::kContact, hidden[Model::kContact], contact_out_);
  for (size_t i = 0; i < pose_out_.size(); ++i) {
    pose_out_[i] = pose_out_[i] * m.output_scale_[i] + m.output_mean_[i];
  }
  for (float& c : contact_out_) c = 1 / (1 + exponential(-c));
}

}  // namespace panache
