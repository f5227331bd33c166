#include "style/networks.h"

#include <algorithm>
#include <cassert>

#include "base/elementary.h"
#include "style/networks_scratch.h"
#include "style/stages/strengths.h"

namespace panache {

StyleNetworks::StyleNetworks(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      strengths_(model_->styles_.size()),
      pose_out_(model_->output_scale_.size()),
      learnt_gates_(model_->learnt_.size(), 1.0f) {}

void StyleNetworks::set_strengths(std::span<const float> strengths) noexcept {
  assert(strengths.size() == strengths_.size());
  std::copy(strengths.begin(), strengths.end(), strengths_.begin());
}

void StyleNetworks::add_memory(Prefetch& prefetch) const noexcept {
  prefetch.add(std::span(strengths_));
  prefetch.add(std::span(pose_out_));
}

StyleNetworks::Styles StyleNetworks::styles_in_force(std::span<const Pass> passes) noexcept {
  Styles styles{passes.front().networks->strengths_.size(), 0};
  for (const Pass& pass : passes) {
    const std::vector<float>& strengths = pass.networks->strengths_;
    size_t begin = 0, end = strengths.size();
    while (begin < end && strengths[begin] == 0) ++begin;
    while (begin < end && strengths[end - 1] == 0) --end;
    styles = {std::min(styles.begin, begin), std::max(styles.end, end)};
  }
  return styles;
}

template <class Out>
void StyleNetworks::add_heads(std::span<const Pass> passes, Styles in_force, int network,
                              Rows<const float> hidden, ScratchArena& arena, Out out) noexcept {
  const Model& m = *passes.front().networks->model_;
  const Model::Heads& heads = m.heads_[network];
  for (const Pass& pass : passes) std::ranges::fill(out(*pass.networks), 0.0f);
  if (heads.layers.empty()) return;
  // Heads that are always active: the only one, or that of no style.
  const size_t always = heads.count > m.built_in() || !m.recipe().style_heads;
  const size_t first = always > 0 ? 0 : in_force.begin;
  const size_t last = std::min(heads.count, always + in_force.end);
  const auto strength = [&](size_t p, size_t h) {
    if (h < always) return 1.0f;
    const float asked = passes[p].networks->strengths_[h - always];
    return network == Model::kPose ? posture_strength(asked) : movement_strength(asked);
  };
  ScratchArena room = arena;
  const Rows<float> answers = room.rows(passes.size(), heads.layers.front().width());
  if (heads.joined()) {
    heads.layers.front().forward(hidden, answers);
    for (size_t p = 0; p < passes.size(); ++p) {
      for (size_t h = first; h < last; ++h) {
        const float* from = answers.row(p) + h * heads.outputs;
        if (strength(p, h) == 0) continue;
        add_scaled(strength(p, h), {from, heads.outputs}, out(*passes[p].networks));
      }
    }
    return;
  }
  const size_t inputs = heads.layers.front().inputs();
  const Rows<float> gathered = room.rows(passes.size(), inputs);
  std::array<size_t, kRowsAtOnce> who;
  for (size_t h = first; h < last; ++h) {
    // The characters of this style share the reading of its weights.
    size_t count = 0;
    for (size_t p = 0; p < passes.size(); ++p) {
      if (strength(p, h) != 0) who[count++] = p;
    }
    if (count == 0) continue;
    Rows<const float> from{hidden.row(who[0]), count, hidden.stride};
    if (who[count - 1] - who[0] + 1 != count) {
      for (size_t k = 0; k < count; ++k) {
        std::copy_n(hidden.row(who[k]), inputs, gathered.row(k));
      }
      from = Rows<float>{gathered.first, count, gathered.stride};
    }
    heads.layers[h].forward(from, {answers.first, count, answers.stride});
    for (size_t k = 0; k < count; ++k) {
      add_scaled(strength(who[k], h), {answers.row(k), heads.outputs},
                 out(*passes[who[k]].networks));
    }
  }
}

Rows<const float> StyleNetworks::shrink(std::span<const Pass> passes, Rows<const float> hidden,
                                        ScratchArena& arena) noexcept {
  const Model& m = *passes.front().networks->model_;
  const Model::Gate& gate = m.gate_;
  if (!gate.present()) return hidden;
  const size_t size = gate.mean.size();
  const Rows<float> activations = arena.rows(passes.size(), size);
  ScratchArena room = arena;
  const Rows<float> centred = room.rows(passes.size(), size);
  const Rows<float> white = room.rows(passes.size(), size);
  for (size_t p = 0; p < passes.size(); ++p) {
    for (size_t i = 0; i < size; ++i) centred.row(p)[i] = hidden.row(p)[i] - gate.mean[i];
  }
  gate.whitening.forward(centred, white);
  const float limit = gate.limit * gate.limit;
  for (size_t p = 0; p < passes.size(); ++p) {
    const float square = square_length({white.row(p), size});
    const float near = square > limit ? limit / square : 1.0f;
    const float wanted = near * near;  // Falls with the fourth power of the distance.
    float& open = passes[p].networks->gate_;
    if (std::isfinite(wanted)) ease_gate(wanted, passes[p].gate_share, open);
    const std::span<float> out(activations.row(p), size);
    if (open == 1) {
      std::copy_n(hidden.row(p), size, out.begin());
    } else {
      std::ranges::copy(gate.mean, out.begin());
      add_scaled(open, {centred.row(p), size}, out);
    }
  }
  return activations;
}

Stance StyleNetworks::stance() const noexcept {
  Stance sum;
  for (size_t s = 0; s < model_->stances_.size(); ++s) {
    if (strengths_[s] == 0) continue;
    const float strength = posture_strength(strengths_[s]);
    const Stance& own = model_->stances_[s];
    sum.heel += strength * own.heel;
    for (size_t f = 0; f < kFeet; ++f) sum.turn[f] += strength * own.turn[f];
  }
  return sum;
}

void StyleNetworks::write_input(std::span<const float> window,
                                std::span<float> input) const noexcept {
  const Model& m = *model_;
  assert(window.size() == m.input_mean_.size());
  standardise(window, m.input_mean_, m.input_factor_, m.input_clip_, input.first(window.size()));
  m.recipe().write_style_inputs(strengths_, input.subspan(window.size()));
}

void StyleNetworks::evaluate(std::span<const Pass> passes, std::span<float> numbers) noexcept {
  const Model& m = *passes.front().networks->model_;
  ScratchArena arena(numbers);
  const size_t inputs = static_cast<size_t>(m.trunks_.inputs());
  const Rows<float> input = arena.rows(passes.size(), inputs);
  for (size_t p = 0; p < passes.size(); ++p) {
    passes[p].networks->write_input(passes[p].window, {input.row(p), inputs});
  }
  const std::span<float> scratch = arena.take(m.trunks_.scratch_size(passes.size()));
  const auto hidden = m.trunks_.forward(Rows<const float>(input), scratch);
  const Rows<const float> activations = shrink(passes, hidden[Model::kPose], arena);
  using Self = StyleNetworks;
  const Styles in_force = styles_in_force(passes);
  add_heads(passes, in_force, Model::kPose, activations, arena,
            [](Self& self) { return std::span(self.pose_out_); });
  add_heads(passes, in_force, Model::kTiming, hidden[Model::kTiming], arena,
            [](Self& self) { return std::span(self.timing_out_); });
  add_heads(passes, in_force, Model::kContact, hidden[Model::kContact], arena,
            [](Self& self) { return std::span(self.contact_out_); });
  add_learnt(passes, scratch, arena);
  for (const Pass& pass : passes) {
    std::vector<float>& pose = pass.networks->pose_out_;
    for (size_t i = 0; i < pose.size(); ++i) {
      pose[i] = pose[i] * m.output_scale_[i] + m.output_mean_[i];
    }
    for (float& c : pass.networks->contact_out_) c = 1 / (1 + exponential(-c));
  }
}

void StyleNetworks::forward(std::span<const float> window, float gate_share) noexcept {
  alignas(kCacheLine) std::array<float, Model::kMaxScratch> numbers;
  const Pass pass{this, window, gate_share};
  evaluate({&pass, 1}, numbers);
}

void StyleNetworks::forward_all(std::span<const Pass> passes) noexcept {
  // Eight characters of most models, and three of the largest.
  alignas(kCacheLine) std::array<float, 32768> numbers;
  static_assert(numbers.size() >= Model::kMaxScratch);
  while (!passes.empty()) {
    const size_t fit = numbers.size() / passes.front().networks->model_->scratch_size_;
    const size_t count = std::min({passes.size(), kRowsAtOnce, fit});
    evaluate(passes.first(count), numbers);
    passes = passes.subspan(count);
  }
}

}  // namespace panache
