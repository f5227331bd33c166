#pragma once
// The times of a step, for every stage.

#include <algorithm>
#include <optional>

#include "base/elementary.h"
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

// The moment of a motion that is due at a step, as each play head gives it: of a clip, of a loop,
// and of a live input. Seconds since the last step; those of input and viewer are equal unless a
// play head runs through the input at another rate.
struct StepMoment {
  double input_seconds, output_seconds;
  // FlightWatch::amount(), if a play head has seen later poses. Otherwise it is derived from the
  // poses so far.
  std::optional<float> flight = {};
  double clip_seconds = 0;         // See StepTime::clip.
  const NextPose* next = nullptr;  // See StepTime::next, from Stepper::see_next().
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
