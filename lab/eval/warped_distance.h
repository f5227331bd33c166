#pragma once
// The distance of a motion from a real one, independent of time and speed.

#include "learn/take.h"

namespace panache {

inline constexpr int kWarpedFrames = 60;  // Of a window; windows start every half second.

// Aligns windows of `take` with the best match in `real`, with free start and end, at half to
// double speed; a window has two seconds, or the length of the shorter motion. Returns the mean
// joint distance in the body frame over windows and frames, cm.
double warped_distance(const Take& take, const Take& real);

}  // namespace panache
