#pragma once
// Motion as joint signals: what the spectra are of.

#include <array>
#include <span>
#include <vector>

#include "learn/take.h"
#include "pose/style_delta.h"

namespace panache::yumer2016 {

// Joint angles as rotation vectors (radians, relative to the parent, of the canonical skeleton, in
// order of the joints), height of the hips (metres) and speed ahead (m/s).
inline constexpr int kHipsHeight = 3 * kHumanJoints, kSpeed = kHipsHeight + 1,
                     kSignals = kSpeed + 1;
using Signals = std::array<float, kSignals>;

// Of each frame of a take (numbers in layout positions). Angles do not jump by a full turn.
std::vector<Signals> joint_signals(const Take& take);

// What turns a body with the signals `before` into one with `after`; the speed as it is.
StyleDelta change_of(const Signals& before, const Signals& after);

}  // namespace panache::yumer2016
