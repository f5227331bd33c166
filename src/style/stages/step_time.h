#pragma once
// The times of a step, for every stage.

#include <algorithm>

#include "base/easing.h"
#include "rig/humanoid.h"

namespace panache {

// Bounds the seconds since the last step: 0 if negative or NaN, at most an hour. After a pause of
// more than Observer::kMaxGap the past is forgotten in any case.
inline double bounded_seconds(double seconds) noexcept {
  constexpr double kLongest = 3600;
  return seconds > 0 ? std::min(seconds, kLongest) : 0.0;
}

// The second pose of a motion, from a clip.
struct NextPose {
  HumanPositions world{};  // Canonical joints, metres.
  float seconds = 0;       // After the first pose.
};

struct StepTime {
  double input = 0;                // Seconds of the input since the last step,
  float output = 0;                // and of the viewer.
  bool first = true;               // The motion starts with this step.
  const NextPose* next = nullptr;  // For a first step, if it is known.
  double clip = 0;                 // Position in a played clip, seconds from its first frame.

  // The gain of a filter with this time constant; the first step goes all the way.
  float gain(float time_constant) const noexcept {
    return first ? 1.0f : filter_gain(output, time_constant);
  }
};

}  // namespace panache
