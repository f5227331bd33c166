#pragma once
// Finds where a motion repeats, so that a cycle can be skipped or repeated.

#include <optional>

#include "style/play/input_ring.h"

namespace panache {

// The length of a cycle: even a shuffle of two steps takes longer than the minimum. Seconds.
inline constexpr double kShortestCycle = 0.4, kLongestCycle = 2.0;
// The poses this long before must be similar, too. Seconds.
inline constexpr double kBeforeCycle = 0.1;

// The offset from `at` (a time in `ring`) of the most similar pose, among offsets from `nearest` to
// `farthest` (seconds, negative is earlier); nothing if none is similar enough. `ring` must reach
// kBeforeCycle further back than both.
std::optional<double> find_cycle(const InputRing& ring, double at, double nearest,
                                 double farthest) noexcept;

}  // namespace panache
