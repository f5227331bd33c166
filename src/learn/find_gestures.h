#pragma once
// Finds the gestures of a style in takes that are paired with neutral ones.

#include <span>
#include <vector>

#include "learn/pairing.h"
#include "learn/take.h"
#include "style/model/gesture.h"

namespace panache {

struct FoundGesture {
  Gesture gesture;
  int take = 0;        // The styled take with the gesture,
  double start = 0;    // and its time, seconds after the first frame.
  float strength = 0;  // How far it exceeds the usual range; 1 is the limit.
};

// Moments of 0.5 to 2.5 s at which the change from neutral to styled leaves the range that is usual
// for its style, except where the body turns, starts or stops. `pairings`: those of one style.
// Strongest first, at most kFoundGestures, without overlap; named as in a model.
inline constexpr int kFoundGestures = 4;
struct FoundGestures {
  std::vector<FoundGesture> gestures;
  float rate = 0;  // All such moments, per second of the styled takes.
};
FoundGestures find_gestures(const std::vector<Take>& takes, std::span<const Pairing> pairings);

}  // namespace panache
