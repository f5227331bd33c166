// The two halves of a style with a side, and what is their mean.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/elementary.h"
#include "style/networks/networks.h"
#include "style/stages/strengths.h"

namespace panache {

void StyleNetworks::set_strengths(std::span<const float> strengths,
                                  std::span<const float> sides) noexcept {
  assert(strengths.size() == strengths_.size());
  assert(sides.empty() || sides.size() == strengths.size());
  std::ranges::copy(strengths, strengths_.begin());
  if (!model_->recipe().style_heads) return;
  if (sides.empty()) {
    std::ranges::fill(sides_, 1.0f);
  } else {
    std::ranges::copy(sides, sides_.begin());
  }
}

float StyleNetworks::share(Half half) const noexcept {
  float all = 0, own = 0;
  for (size_t s = 0; s < strengths_.size(); ++s) {
    const float strength = std::abs(strengths_[s]);
    all += strength;
    own += strength * share(half, s);
  }
  if (all > 0) return own / all;
  return half == Half::captured ? 1.0f : 0.0f;
}

size_t StyleNetworks::passes(std::span<const float> window, float gate_share,
                             std::span<Pass, kMaxPasses> out) noexcept {
  // The gate of a half that did not run knows nothing of the motion since.
  const bool starts = !halves_[0].runs && !halves_[1].runs;
  size_t count = 0;
  for (const Half half : {Half::captured, Half::mirrored}) {
    HalfMemory& memory = of(half);
    const bool wakes = !memory.runs && !starts;
    memory.runs = share(half) > 0 || (is_person_ && half == Half::captured);
    if (memory.runs) out[count++] = {this, window, wakes ? 1.0f : gate_share, half};
  }
  if (!of(Half::captured).runs) {
    HalfMemory& sum = of(Half::captured);
    std::ranges::fill(sum.pose, 0.0f);
    sum.timing = {};
    sum.contact = {};
  }
  return count;
}

void StyleNetworks::add_mirrored() noexcept {
  HalfMemory& mirrored = of(Half::mirrored);
  HalfMemory& sum = of(Half::captured);
  model_->recipe().mirror_target(mirrored.pose);
  std::swap(mirrored.contact[0], mirrored.contact[1]);
  add_scaled(1, mirrored.pose, sum.pose);
  add_scaled(1, mirrored.timing, sum.timing);
  add_scaled(1, mirrored.contact, sum.contact);
}

std::array<float, 2> StyleNetworks::contact() const noexcept {
  const auto probability = [](float logit) { return 1 / (1 + exponential(-logit)); };
  return {probability(result().contact[0]), probability(result().contact[1])};
}

float StyleNetworks::gate() const noexcept {
  const HalfMemory &captured = of(Half::captured), &mirrored = of(Half::mirrored);
  if (captured.learnt_gates.empty()) {
    return share(Half::captured) * captured.gate + share(Half::mirrored) * mirrored.gate;
  }
  const size_t built_in = model_->built_in();
  const auto gate_of = [&](const HalfMemory& memory, size_t style) {
    return style < built_in ? memory.gate : memory.learnt_gates[style - built_in];
  };
  float total = 0, sum = 0;
  for (size_t s = 0; s < strengths_.size(); ++s) {
    const float strength = std::abs(strengths_[s]);
    total += strength;
    sum += strength * (share(Half::captured, s) * gate_of(captured, s) +
                       share(Half::mirrored, s) * gate_of(mirrored, s));
  }
  return total > 0 ? std::min(sum / total, 1.0f) : captured.gate;
}

Stance StyleNetworks::stance() const noexcept {
  Stance sum;
  if (is_person_) sum = model_->persons()->stance(person_);
  for (size_t s = 0; s < model_->stances_.size(); ++s) {
    if (strengths_[s] == 0) continue;
    const float strength = posture_strength(strengths_[s]);
    const float captured = strength * share(Half::captured, s);
    const float mirrored = strength * share(Half::mirrored, s);
    const Stance& own = model_->stances_[s];
    sum.heel += strength * own.heel;
    for (size_t f = 0; f < kFeet; ++f) {
      sum.turn[f] += captured * own.turn[f] - mirrored * own.turn[1 - f];
    }
  }
  return sum;
}

}  // namespace panache
