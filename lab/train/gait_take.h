#pragma once
// Gait analysis of a walking or running take: phase, path, and the body relative to the path.

#include <numbers>
#include <vector>

#include "learn/take.h"
#include "walker/gait.h"

namespace panache {

inline constexpr double kGaitCycle = 2 * std::numbers::pi;  // Radians.

struct GaitFrame {
  double phase;    // Radians, increasing; at multiples of 2 pi the left ankle is furthest ahead.
  double cadence;  // Gait cycles (two steps) per second.
  Going going;
  double sideways;  // Speed to the body's left, m/s.
  Channels channels;
};

// One per frame of the take; empty if it contains no steps.
std::vector<GaitFrame> gait_frames(const Take& take);

// A frame of a take as channels over a path at `origin` (world, y = 0) with heading `facing`.
Channels gait_channels(const Take& take, int frame, Vec3 origin, float facing);

}  // namespace panache
