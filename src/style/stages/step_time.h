#pragma once
// The times of a step, for every stage.

#include <algorithm>

#include "base/one_pole.h"
#include "rig/humanoid.h"

namespace panache {

// The seconds since the last step as a step takes them, whatever a clock gives: none where they are
// negative or not a number, and an hour where they are longer or infinite. A pause of more than
// Observer::kMaxGap is forgotten in any case.
inline double bounded_seconds(double seconds) noexcept {
  constexpr double kLongest = 3600;
  return seconds > 0 ? std::min(seconds, kLongest) : 0.0;
}

// The pose after a first one, as a clip has it.
struct NextPose {
  HumanPositions world{};  // Canonical joints, metres.
  float seconds = 0;       // After the first pose.
};

struct StepTime {
  double input = 0;                // Seconds of the input since the last step,
  float output = 0;                // and of the viewer.
  bool first = true;               // No step before this one counts.
  const NextPose* next = nullptr;  // After a first step, where it is known.
  double clip = 0;                 // Where a clip that is played is, seconds since its first frame.

  // The gain of a filter with this time constant; the first step goes all the way.
  float gain(float time_constant) const noexcept {
    return first ? 1.0f : filter_gain(output, time_constant);
  }
};

}  // namespace panache
