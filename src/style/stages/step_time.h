#pragma once
// What every stage of a step knows of time.

#include <cmath>

#include "base/elementary.h"

namespace panache {

// Share of the way to its target that a one-pole filter goes in `seconds`.
inline float filter_gain(float seconds, float time_constant) noexcept {
  return time_constant > 0 ? 1 - exponential(-seconds / time_constant) : 1.0f;
}

// Goes the share `gain` of the way to `target`, and all of it from `near` on.
inline void approach(float& value, float target, float gain, float near) noexcept {
  value += gain * (target - value);
  if (std::abs(target - value) < near) value = target;
}

struct StepTime {
  double input = 0;   // Seconds of the input since the last step,
  float output = 0;   // and of the viewer.
  bool first = true;  // No step before this one counts.

  // The gain of a filter with this time constant; the first step goes all the way.
  float gain(float time_constant) const noexcept {
    return first ? 1.0f : filter_gain(output, time_constant);
  }
};

}  // namespace panache
