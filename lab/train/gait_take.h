#pragma once
// A take of someone walking or running, as a gait sees it: phase, path, and the body over the path.

#include <vector>

#include "learn/take.h"
#include "walker/gait.h"

namespace panache {

struct GaitFrame {
  double phase;    // Radians, growing; at a multiple of a turn the left ankle is furthest ahead.
  double cadence;  // Cycles of two steps a second.
  Going going;
  double sideways;  // Speed to the left of where the body looks, m/s.
  Channels channels;
};

// One per frame of the take; empty where it shows no steps.
std::vector<GaitFrame> gait_frames(const Take& take);

// A frame of a take as channels over a path at `origin` (world, y = 0) with heading `facing`.
Channels gait_channels(const Take& take, int frame, Vec3 origin, float facing);

}  // namespace panache
