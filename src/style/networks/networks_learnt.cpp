// Styles learnt in closed form, with their gates, and persons.

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "style/networks/networks.h"
#include "style/stages/strengths.h"

namespace panache {

void StyleNetworks::add_learnt(std::span<const Pass> passes, std::span<const float> scratch,
                               ScratchArena& arena) {
  const Model& m = *passes.front().networks->model_;
  if (m.learnt_.empty()) return;
  ScratchArena room = arena;
  const size_t count = m.activation_count(), first = m.built_in();
  const std::span<float> activations = room.take(count).first(count);
  const std::span<float> drawn = room.take(count).first(count);
  for (size_t p = 0; p < passes.size(); ++p) {
    const StyleNetworks& self = *passes[p].networks;
    HalfMemory& half = memory(passes[p]);
    bool gathered = false;
    for (size_t k = 0; k < m.learnt_.size(); ++k) {
      const float asked = self.strengths_[first + k];
      const float share = self.share(passes[p].half, first + k);
      if (asked == 0 || share == 0) continue;
      if (!gathered) m.trunks_.all_layers(Model::kPose, p, passes.size(), scratch, activations);
      gathered = true;
      const Model::Learnt& learnt = m.learnt_[k];
      ScratchArena rest = room;
      const float far = self.leverage(learnt, activations, drawn, rest);
      const float wanted = far > 1 ? 1 / far : 1.0f;
      float& open = half.learnt_gates[k];
      if (std::isfinite(far)) ease_gate(wanted, passes[p].gate_share, open);
      for (size_t i = 0; i < count; ++i) {
        drawn[i] = learnt.mean[i] + open * (activations[i] - learnt.mean[i]);
      }
      const std::span<float> output = rest.take(learnt.head.width());
      learnt.head.forward({drawn.data(), 1, 0}, {output.data(), 1, 0});
      constexpr int kChange = StyleDelta::kSize;
      const float movement = share * movement_strength(asked);
      add_scaled(share * posture_strength(asked), output.first<kChange>(), half.pose);
      add_scaled(movement, output.subspan<kChange, 1>(), half.timing);
      add_scaled(movement, output.subspan<kChange + 1, 2>(), half.contact);
    }
  }
}

float StyleNetworks::leverage(const Model::Learnt& learnt, std::span<const float> activations,
                              std::span<float> apart, ScratchArena& arena) const noexcept {
  const std::vector<float>& factor = model_->activation_factor_;
  for (size_t i = 0; i < activations.size(); ++i) {
    apart[i] = (activations[i] - learnt.mean[i]) * factor[i];
  }
  ScratchArena room = arena;
  const std::span<float> along = room.take(learnt.gate.width());
  learnt.gate.forward({activations.data(), 1, 0}, {along.data(), 1, 0});
  float sum = learnt.gate_residual * square_length(apart);
  for (size_t d = 0; d < learnt.gate_weights.size(); ++d)
    sum += learnt.gate_weights[d] * along[d] * along[d];
  return sum;
}

void StyleNetworks::activations(std::span<const float> window,
                                std::span<float> out) const noexcept {
  alignas(kCacheLine) std::array<float, Model::kMaxScratch> numbers;
  ScratchArena arena(numbers);
  const size_t inputs = static_cast<size_t>(model_->trunks_.inputs());
  const Rows<float> input = arena.rows(1, inputs);
  write_input(window, Half::captured, {input.row(0), inputs});
  const std::span<float> scratch = arena.take(model_->trunks_.scratch_size(1));
  model_->trunks_.forward(Rows<const float>(input), scratch);
  model_->trunks_.all_layers(Model::kPose, 0, 1, scratch, out);
}

// The person in the output of the networks.

void StyleNetworks::set_person(std::span<const float> numbers) noexcept {
  is_person_ = false;
  if (!model_->persons()) return;
  for (size_t a = 0; a < model_->persons()->axes(); ++a) {
    person_[a] = numbers[a];
    is_person_ = is_person_ || numbers[a] != 0;
  }
}

void StyleNetworks::ease_person(const PersonNumbers& numbers, float gain) noexcept {
  constexpr float kNear = 1e-4f;
  PersonNumbers eased = person_;
  for (size_t a = 0; a < eased.size(); ++a) approach(eased[a], numbers[a], gain, kNear);
  set_person(eased);
}

void StyleNetworks::add_person(std::span<const Pass> passes, std::span<const float> scratch,
                               ScratchArena& arena) noexcept {
  const Model& m = *passes.front().networks->model_;
  if (!m.persons()) return;
  const PersonSpace& space = *m.persons();
  // A person is not mirrored: people have a side.
  const auto has_person = [](const Pass& pass) {
    return pass.half == Half::captured && pass.networks->is_person_;
  };
  // The characters with a person share the reading of its weights.
  std::array<size_t, kRowsAtOnce> who;
  size_t rows = 0;
  for (size_t p = 0; p < passes.size(); ++p) {
    if (has_person(passes[p])) who[rows++] = p;
  }
  if (rows == 0) return;
  ScratchArena room = arena;
  const size_t units = space.units(), inputs = space.head().inputs();
  const Rows<float> reduced = room.rows(rows, space.reduction().width());
  {
    ScratchArena rest = room;
    const size_t count = m.activation_count();
    const Rows<float> activations = rest.rows(rows, count);
    for (size_t k = 0; k < rows; ++k) {
      m.trunks_.all_layers(Model::kPose, who[k], passes.size(), scratch,
                           {activations.row(k), count});
    }
    space.reduction().forward(Rows<const float>(activations), reduced);
  }
  const Rows<float> products = room.rows(rows, inputs);
  for (size_t k = 0; k < rows; ++k) {
    const StyleNetworks& self = *passes[who[k]].networks;
    const float open = memory(passes[who[k]]).gate;
    float* out = products.row(k);
    for (size_t a = 0; a < space.axes(); ++a) {
      const float number = self.person_[a];
      for (size_t i = 0; i < units; ++i) *out++ = number * open * reduced.row(k)[i];
      *out++ = number;
    }
  }
  const Rows<float> outputs = room.rows(rows, space.head().width());
  space.head().forward(Rows<const float>(products), outputs);
  constexpr int kChange = StyleDelta::kSize;
  for (size_t k = 0; k < rows; ++k) {
    HalfMemory& half = memory(passes[who[k]]);
    const std::span<const float> output(outputs.row(k), kLearntOutputs);
    add_scaled(1, output.first<kChange>(), half.pose);
    add_scaled(1, output.subspan<kChange, 1>(), half.timing);
    add_scaled(1, output.subspan<kChange + 1, 2>(), half.contact);
  }
}

}  // namespace panache
