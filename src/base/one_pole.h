#pragma once
// Filters of first order.

#include <cmath>

#include "base/elementary.h"

namespace panache {

// Share of the way to its target that such a filter goes in `seconds`.
inline float filter_gain(float seconds, float time_constant) noexcept {
  return time_constant > 0 ? 1 - exponential(-seconds / time_constant) : 1.0f;
}

// Goes the share `gain` of the way to `target`, and all of it from `near` on.
inline void approach(float& value, float target, float gain, float near) noexcept {
  value += gain * (target - value);
  if (std::abs(target - value) < near) value = target;
}

}  // namespace panache
