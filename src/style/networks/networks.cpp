#include "style/networks/networks.h"

#include <algorithm>
#include <cassert>

#include "pose/features.h"
#include "style/stages/strengths.h"

namespace panache {

StyleNetworks::StyleNetworks(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      strengths_(model_->styles_.size()),
      sides_(strengths_.size(), 1.0f) {
  for (HalfMemory& half : halves_) {
    half.pose.resize(model_->output_scale_.size());
    half.learnt_gates.assign(model_->learnt_.size(), 1.0f);
  }
}

void StyleNetworks::add_memory(Prefetch& prefetch) const noexcept {
  prefetch.add(std::span(strengths_));
  prefetch.add(std::span(sides_));
  prefetch.add(std::span(result().pose));
}

StyleNetworks::Styles StyleNetworks::active_styles(std::span<const Pass> passes) noexcept {
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
void StyleNetworks::add_heads(std::span<const Pass> passes, Styles active, int network,
                              Rows<const float> hidden, ScratchArena& arena, Out out) noexcept {
  const Model& m = *passes.front().networks->model_;
  const Model::Heads& heads = m.heads_[network];
  for (const Pass& pass : passes) std::ranges::fill(out(memory(pass)), 0.0f);
  if (heads.layers.empty()) return;
  // Heads that are always active: the only one, or that of no style.
  const size_t always = heads.count > m.built_in() || !m.recipe().style_heads;
  const size_t first = always > 0 ? 0 : active.begin;
  const size_t last = std::min(heads.count, always + active.end);
  const auto strength = [&](size_t p, size_t h) {
    const auto& [networks, window, gate_share, half] = passes[p];
    if (h < always) return networks->share(half);
    const float asked = networks->strengths_[h - always];
    return networks->share(half, h - always) *
           (network == Model::kPose ? posture_strength(asked) : movement_strength(asked));
  };
  ScratchArena room = arena;
  const Rows<float> outputs = room.rows(passes.size(), heads.layers.front().width());
  if (heads.joined()) {
    heads.layers.front().forward(hidden, outputs);
    for (size_t p = 0; p < passes.size(); ++p) {
      for (size_t h = first; h < last; ++h) {
        const float* from = outputs.row(p) + h * heads.outputs;
        if (strength(p, h) == 0) continue;
        add_scaled(strength(p, h), {from, heads.outputs}, out(memory(passes[p])));
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
    heads.layers[h].forward(from, {outputs.first, count, outputs.stride});
    for (size_t k = 0; k < count; ++k) {
      add_scaled(strength(who[k], h), {outputs.row(k), heads.outputs}, out(memory(passes[who[k]])));
    }
  }
}

void StyleNetworks::ease_gates(std::span<const Pass> passes, Rows<const float> hidden,
                               Rows<float> centred, ScratchArena& arena) noexcept {
  const Model::Gate& gate = passes.front().networks->model_->gate_;
  const size_t size = gate.mean.size();
  ScratchArena room = arena;
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
    if (std::isfinite(wanted)) {
      ease_gate(wanted, passes[p].gate_share, memory(passes[p]).gate);
    }
  }
}

Rows<const float> StyleNetworks::shrink(std::span<const Pass> passes, Rows<const float> hidden,
                                        ScratchArena& arena) noexcept {
  const Model::Gate& gate = passes.front().networks->model_->gate_;
  if (!gate.present()) return hidden;
  const size_t size = gate.mean.size();
  const Rows<float> activations = arena.rows(passes.size(), size);
  ScratchArena room = arena;
  const Rows<float> centred = room.rows(passes.size(), size);
  ease_gates(passes, hidden, centred, room);
  for (size_t p = 0; p < passes.size(); ++p) {
    const float open = memory(passes[p]).gate;
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

void StyleNetworks::add_reduced(std::span<const Pass> passes, Styles active,
                                std::span<const float> scratch, ScratchArena& arena) noexcept {
  const Model& m = *passes.front().networks->model_;
  const Model::Heads& heads = m.heads_[Model::kPose];
  ScratchArena room = arena;
  const size_t count = m.activation_count();
  const Rows<float> activations = room.rows(passes.size(), count);
  for (size_t p = 0; p < passes.size(); ++p) {
    std::ranges::fill(memory(passes[p]).pose, 0.0f);
    m.trunks_.all_layers(Model::kPose, p, passes.size(), scratch, {activations.row(p), count});
  }
  const Rows<float> gathered = room.rows(passes.size(), count);
  std::array<size_t, kRowsAtOnce> who;
  const size_t last = std::min(heads.count, active.end);
  const auto strength = [&](size_t p, size_t h) {
    const StyleNetworks& self = *passes[p].networks;
    return self.share(passes[p].half, h) * posture_strength(self.strengths_[h]);
  };
  for (size_t h = active.begin; h < last; ++h) {
    // The characters of this style share the reading of its weights.
    size_t rows = 0;
    for (size_t p = 0; p < passes.size(); ++p) {
      if (strength(p, h) == 0) continue;
      std::copy_n(activations.row(p), count, gathered.row(rows));
      who[rows++] = p;
    }
    if (rows == 0) continue;
    const PackedLayer& reduction = m.reductions_[h];
    ScratchArena rest = room;
    const Rows<float> reduced = rest.rows(rows, reduction.width());
    reduction.forward({gathered.first, rows, gathered.stride}, reduced);
    for (size_t k = 0; k < rows; ++k) {
      const float open = memory(passes[who[k]]).gate;
      for (size_t i = 0; i < reduction.width(); ++i) reduced.row(k)[i] *= open;
    }
    const Rows<float> outputs = rest.rows(rows, heads.layers[h].width());
    heads.layers[h].forward(Rows<const float>(reduced), outputs);
    for (size_t k = 0; k < rows; ++k) {
      add_scaled(strength(who[k], h), {outputs.row(k), heads.outputs}, memory(passes[who[k]]).pose);
    }
  }
}

void StyleNetworks::write_input(std::span<const float> window, Half half,
                                std::span<float> input) const noexcept {
  const Model& m = *model_;
  assert(window.size() == m.input_mean_.size());
  const std::span<float> poses = input.first(window.size());
  if (half == Half::mirrored) {
    std::ranges::copy(window, poses.begin());
    mirror_poses(m.layout(), poses);
    window = poses;
  }
  standardise(window, m.input_mean_, m.input_factor_, m.input_clip_, poses);
  m.recipe().write_style_inputs(strengths_, input.subspan(window.size()));
}

void StyleNetworks::evaluate(std::span<const Pass> passes, std::span<float> numbers) noexcept {
  const Model& m = *passes.front().networks->model_;
  ScratchArena arena(numbers);
  const size_t inputs = static_cast<size_t>(m.trunks_.inputs());
  const Rows<float> input = arena.rows(passes.size(), inputs);
  for (size_t p = 0; p < passes.size(); ++p) {
    passes[p].networks->write_input(passes[p].window, passes[p].half, {input.row(p), inputs});
  }
  const std::span<float> scratch = arena.take(m.trunks_.scratch_size(passes.size()));
  const auto hidden = m.trunks_.forward(Rows<const float>(input), scratch);
  const Styles active = active_styles(passes);
  if (m.reductions_.empty()) {
    const Rows<const float> activations = shrink(passes, hidden[Model::kPose], arena);
    add_heads(passes, active, Model::kPose, activations, arena,
              [](HalfMemory& half) { return std::span(half.pose); });
  } else {
    if (m.gate_.present()) {
      ScratchArena room = arena;
      const Rows<float> centred = room.rows(passes.size(), m.gate_.mean.size());
      ease_gates(passes, hidden[Model::kPose], centred, room);
    }
    add_reduced(passes, active, scratch, arena);
  }
  add_heads(passes, active, Model::kTiming, hidden[Model::kTiming], arena,
            [](HalfMemory& half) { return std::span(half.timing); });
  add_heads(passes, active, Model::kContact, hidden[Model::kContact], arena,
            [](HalfMemory& half) { return std::span(half.contact); });
  add_learnt(passes, scratch, arena);
  add_person(passes, scratch, arena);
  for (const Pass& pass : passes) {
    std::vector<float>& pose = memory(pass).pose;
    const float share = pass.networks->share(pass.half);
    for (size_t i = 0; i < pose.size(); ++i) {
      pose[i] = pose[i] * m.output_scale_[i] + share * m.output_mean_[i];
    }
    if (pass.half == Half::mirrored) pass.networks->add_mirrored();
  }
}

void StyleNetworks::forward(std::span<const float> window, float gate_share) noexcept {
  alignas(kCacheLine) std::array<float, Model::kMaxScratch> numbers;
  std::array<Pass, kMaxPasses> all;
  const size_t count = passes(window, gate_share, all);
  for (const Pass& pass : std::span(all).first(count)) evaluate({&pass, 1}, numbers);
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
