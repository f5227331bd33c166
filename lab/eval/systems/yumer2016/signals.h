#pragma once
// Motion as joint signals, the input of spectral analysis.

#include <array>
#include <span>
#include <vector>

#include "learn/take.h"
#include "pose/style_delta.h"

namespace panache::yumer2016 {

// Joint angles as rotation vectors (radians, relative to the parent, in the order of the canonical
// skeleton's joints), height of the hips (metres) and forward speed (m/s).
inline constexpr int kHipsHeight = 3 * kHumanJoints, kSpeed = kHipsHeight + 1,
                     kSignals = kSpeed + 1;
using Signals = std::array<float, kSignals>;

// The signals of each frame of a take (features in layout positions), with unwrapped angles.
std::vector<Signals> joint_signals(const Take& take);

// The change from a body with signals `before` to one with `after`; the speed stays.
StyleDelta change_of(const Signals& before, const Signals& after);

}  // namespace panache::yumer2016
