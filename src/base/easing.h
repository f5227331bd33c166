#pragma once
// Ways from one value to another: a smooth step, a list of values, a first-order filter.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "base/elementary.h"

namespace panache {

// Rises from 0 to 1 with `x`, with zero slope at both ends; constant beyond them.
inline float smooth_step(float x) noexcept {
  x = std::clamp(x, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

// The value at the fractional index `at` of a non-empty list, linearly interpolated; clamped to the
// first and last value.
inline double between(const std::vector<double>& list, double at) {
  const size_t a = std::min(static_cast<size_t>(std::max(at, 0.0)), list.size() - 1);
  const size_t b = std::min(a + 1, list.size() - 1);
  return std::lerp(list[a], list[b], at - static_cast<double>(a));
}

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
