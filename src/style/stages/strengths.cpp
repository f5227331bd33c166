#include "style/stages/strengths.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace panache {
namespace {

constexpr float kNear = 1e-4f;

float bounded(float amount, float max) {
  return std::isfinite(amount) ? std::clamp(amount, 0.0f, max) : 1.0f;
}

float exaggerated(float strength, float even) {
  const float size = std::abs(strength);
  return size <= even ? strength : std::copysign(even + kBeyondEven * (size - even), strength);
}

}  // namespace

float posture_strength(float strength) noexcept { return exaggerated(strength, kPostureEven); }
float movement_strength(float strength) noexcept { return exaggerated(strength, kMovementEven); }

void EasedStrengths::step(std::span<const float> strengths, std::span<const float> sides,
                          const Shape& shape, const StepTime& time) noexcept {
  assert(strengths.size() == now_.size() && sides.size() == now_.size());
  const float gain = time.gain(ease_seconds_);
  const auto ease = [&](float& value, float wanted, float max) {
    approach(value, bounded(wanted, max), gain, kNear);
  };
  ease(shape_.posture, shape.posture, Shape::kMax);
  ease(shape_.dynamics, shape.dynamics, Shape::kMax);
  ease(shape_.timing, shape.timing, Shape::kMax);
  ease(shape_.foot_lock, shape.foot_lock, 1);
  ease(shape_.hand_contacts, shape.hand_contacts, 1);
  ease(shape_.energy, shape.energy, Shape::kMax);
  for (size_t r = 0; r < kRegions; ++r) {
    ease(shape_.regions[r], shape.regions[r], Shape::kMax);
  }

  const float all = bounded(shape.strength, Shape::kMax);
  float total = 0, posture = 0, movement = 0;
  for (size_t i = 0; i < now_.size(); ++i) {
    approach(sides_[i], sides[i], now_[i] == 0 ? 1.0f : gain, kNear);
    if (strengths[i] == 0 && now_[i] == 0) continue;  // True for most styles.
    const float wanted = std::isfinite(strengths[i]) ? strengths[i] * all : 0.0f;
    approach(now_[i], std::clamp(wanted, -kMaxStrength, kMaxStrength), gain, kNear);
    total += std::abs(now_[i]);
    posture += std::abs(posture_strength(now_[i]));
    movement += std::abs(movement_strength(now_[i]));
  }
  active_shape_ = shape_;
  if (movement < posture) active_shape_.dynamics *= movement / posture;
  amount_ = std::min(1.0f, 4 * total);
}

}  // namespace panache
