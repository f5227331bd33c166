#pragma once
// How far a motion is from a real one, wherever in it the same is done and however fast.

#include "learn/take.h"

namespace panache {

inline constexpr int kWarpedFrames = 60;  // Of a window; the next one begins half a second later.

// Windows of `take` are laid on `real` where they fit best, start and end free, at half to double
// its speed; a window is two seconds, or as long as the shorter of the two. The mean over windows,
// their frames and the joints of the distance in the body frame, cm.
double warped_distance(const Take& take, const Take& real);

}  // namespace panache
