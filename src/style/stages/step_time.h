#pragma once
// What every stage of a step knows of time.

#include "base/one_pole.h"

namespace panache {

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
