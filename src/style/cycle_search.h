#pragma once
// Where a motion repeats itself: so a cycle can be left out, or played again.

#include <optional>

#include "style/input_ring.h"

namespace panache {

// A cycle is at least this long: a shuffle of two steps takes longer. Seconds.
inline constexpr double kShortestCycle = 0.4, kLongestCycle = 2.0;
// The moments this long before must be alike, too. Seconds.
inline constexpr double kBeforeCycle = 0.1;

// How far from `at` (a time of `ring`) the body looks most as it does then, of all times `nearest`
// to `farthest` away (seconds, below zero is earlier); nothing where it never looks alike enough.
// `ring` reaches kBeforeCycle further back than both.
std::optional<double> find_cycle(const InputRing& ring, double at, double nearest,
                                 double farthest) noexcept;

}  // namespace panache
