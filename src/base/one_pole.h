#pragma once
// First-order filters.

#include <cmath>

#include "base/elementary.h"

namespace panache {

// The fraction of the distance to its target that a filter covers in `seconds`.
inline float filter_gain(float seconds, float time_constant) noexcept {
  return time_constant > 0 ? 1 - exponential(-seconds / time_constant) : 1.0f;
}

// Moves by the fraction `gain` towards `target`; within `near` of it, all the way.
inline void approach(float& value, float target, float gain, float near) noexcept {
  value += gain * (target - value);
  if (std::abs(target - value) < near) value = target;
}

}  // namespace panache
