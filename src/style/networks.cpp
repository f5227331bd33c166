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

float exaggerated(float strength) {
  const float size = std::abs(strength);
  return size <= 1 ? strength : std::copysign(1 + kExaggeration * (size - 1), strength);
}

}  // namespace

// Room on the stack, handed out in parts that begin on a cache line.
class StyleNetworks::ScratchArena {
 public:
  explicit ScratchArena(std::span<float> numbers) : remaining_(numbers) {}
  std::span<float> take(size_t numbers) {
    const std::span<float> part = remaining_.first(padded(numbers));
    remaining_ = remaining_.subspan(part.size());
    return part;
  }
  // So many rows of so many numbers.
  Rows<float> rows(size_t count, size_t numbers) {
    return {take(count * padded(numbers)).data(), count, padded(numbers)};
  }
  // What is there by now, to be handed out again by a copy.
  std::span<float> remaining() const { return remaining_; }

 private:
  std::span<float> remaining_;
};

StyleNetworks::StyleNetworks(std::shared_ptr<const Model> model)
    : model_(std::move(model)),
      strengths_(model_->styles_.size()),
      pose_out_(model_->output_scale_.size()),
      learnt_gates_(model_->learnt_.size(), 1.0f) {}

void StyleNetworks::set_strengths(std::span<const float> strengths) noexcept {
  assert(strengths.size() == strengths_.size());
  std::copy(strengths.begin(), strengths.end(), strengths_.begin());
}

float StyleNetworks::head_strength(const Model::Heads& heads, size_t head) const noexcept {
  // Heads that are in force whatever the styles: the only one, or that of no style.
  const size_t always = heads.count > model_->built_in() || !model_->recipe().style_heads;
  return head < always ? 1.0f : exaggerated(strengths_[head - always]);
}

template <class Out>
void StyleNetworks::add_heads(std::span<const Pass> passes, int network, Rows<const float> hidden,
                              ScratchArena& arena, Out out) noexcept {
  const Model::Heads& heads = passes.front().networks->model_->heads_[network];
  for (const Pass& pass : passes) std::ranges::fill(out(*pass.networks), 0.0f);
  if (heads.layers.empty()) return;
  ScratchArena room = arena;
  const Rows<float> answers = room.rows(passes.size(), heads.layers.front().width());
  if (heads.joined()) heads.layers.front().forward(hidden, answers);
  for (size_t h = 0; h < heads.count; ++h) {
    for (size_t p = 0; p < passes.size(); ++p) {
      const float strength = passes[p].networks->head_strength(heads, h);
      if (strength == 0) continue;
      const Rows<float> answer{answers.row(p), 1, 0};
      if (!heads.joined()) heads.layers[h].forward({hidden.row(p), 1, 0}, answer);
      const float* from = answer.first + (heads.joined() ? h * heads.outputs : 0);
      add_scaled(strength, {from, heads.outputs}, out(*passes[p].networks));
    }
  }
}

float StyleNetworks::gate() const noexcept {
  if (learnt_gates_.empty()) return gate_;
  const size_t built_in = model_->built_in();
  float total = 0, sum = 0;
  for (size_t s = 0; s < strengths_.size(); ++s) {
    const float strength = std::abs(strengths_[s]);
    total += strength;
    sum += strength * (s < built_in ? gate_ : learnt_gates_[s - built_in]);
  }
  return total > 0 ? std::min(sum / total, 1.0f) : gate_;
}

void StyleNetworks::add_learnt(std::span<const Pass> passes, std::span<const float> scratch,
                               ScratchArena& arena) {
  const Model& m = *passes.front().networks->model_;
  if (m.learnt_.empty()) return;
  ScratchArena room = arena;
  const size_t count = m.activation_count(), first = m.built_in();
  const std::span<float> activations = room.take(count).first(count);
  const std::span<float> drawn = room.take(count).first(count);
  for (size_t p = 0; p < passes.size(); ++p) {
    StyleNetworks& self = *passes[p].networks;
    bool gathered = false;
    for (size_t k = 0; k < m.learnt_.size(); ++k) {
      const float strength = exaggerated(self.strengths_[first + k]);
      if (strength == 0) continue;
      if (!gathered) m.trunks_.all_layers(Model::kPose, p, passes.size(), scratch, activations);
      gathered = true;
      const Model::Learnt& learnt = m.learnt_[k];
      ScratchArena rest = room;
      const float far = self.leverage(learnt, activations, drawn, rest);
      const float wanted = far > 1 ? 1 / far : 1.0f;
      float& open = self.learnt_gates_[k];
      if (std::isfinite(far)) open += passes[p].gate_share * (wanted - open);
      for (size_t i = 0; i < count; ++i) {
        drawn[i] = learnt.mean[i] + open * (activations[i] - learnt.mean[i]);
      }
      const std::span<float> answer = rest.take(learnt.head.width());
      learnt.head.forward({drawn.data(), 1, 0}, {answer.data(), 1, 0});
      constexpr int kChange = StyleDelta::kSize;
      add_scaled(strength, answer.first<kChange>(), self.pose_out_);
      add_scaled(strength, answer.subspan<kChange, 1>(), self.timing_out_);
      add_scaled(strength, answer.subspan<kChange + 1, 2>(), self.contact_out_);
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
  write_input(window, {input.row(0), inputs});
  const std::span<float> scratch = arena.take(model_->trunks_.scratch_size(1));
  model_->trunks_.forward(Rows<const float>(input), scratch);
  model_->trunks_.all_layers(Model::kPose, 0, 1, scratch, out);
}

Rows<const float> StyleNetworks::shrink(std::span<const Pass> passes, Rows<const float> hidden,
                                        ScratchArena& arena) noexcept {
  const Model& m = *passes.front().networks->model_;
  const Model::Gate& gate = m.gate_;
  if (!gate.present()) return hidden;
  const size_t size = gate.mean.size();
  const Rows<float> activations = arena.rows(passes.size(), size);
  const Rows<float> centred = arena.rows(passes.size(), size);
  const Rows<float> white = arena.rows(passes.size(), size);
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
    if (std::isfinite(wanted)) open += passes[p].gate_share * (wanted - open);
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

void StyleNetworks::write_input(std::span<const float> window,
                                std::span<float> input) const noexcept {
  const Model& m = *model_;
  assert(window.size() == m.input_mean_.size());
  standardise(window, m.input_mean_, m.input_factor_, m.input_clip_, input.first(window.size()));
  m.recipe().write_style_inputs(strengths_, input.subspan(window.size()));
}

void StyleNetworks::answer_constants() noexcept {
  std::ranges::fill(pose_out_, 0.0f);
  timing_out_ = {};
  contact_out_ = {};
  for (size_t s = 0; s < strengths_.size(); ++s) {
    const Model::ConstantStyle& style = model_->constants_[s];
    const float strength = exaggerated(strengths_[s]);
    std::array<float, StyleDelta::kSize> change;
    pack(style.change, change);
    add_scaled(strength, change, pose_out_);
    timing_out_[0] += strength * style.log_rate;
  }
}

void StyleNetworks::evaluate(std::span<const Pass> passes, std::span<float> numbers) noexcept {
  const Model& m = *passes.front().networks->model_;
  if (!m.constants_.empty()) {
    for (const Pass& pass : passes) pass.networks->answer_constants();
    return;
  }
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
  add_heads(passes, Model::kPose, activations, arena,
            [](Self& self) { return std::span(self.pose_out_); });
  add_heads(passes, Model::kTiming, hidden[Model::kTiming], arena,
            [](Self& self) { return std::span(self.timing_out_); });
  add_heads(passes, Model::kContact, hidden[Model::kContact], arena,
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
