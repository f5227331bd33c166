#pragma once
// Detects joints bent beyond the human range of motion.

#include "rig/humanoid.h"

namespace panache {

// The joint that exceeds its limit most, and by how much; 0 degrees if none does.
struct BeyondLimit {
  HumanJoint joint = HumanJoint::hips;
  float degrees = 0;
};

// Checks spine, head, shoulders, elbows, hips and knees of a canonical body (any position and
// heading) as far as positions show them: the angle and direction of each limb's swing, and the
// direction in which elbows and knees bend; not twist.
// The limits are those of the product (rig/beyond_range.h) with twice their margin, 20 degrees.
BeyondLimit beyond_limits(const HumanPositions& body) noexcept;

// How far thigh and knee of a leg, 0 left or 1 right, exceed the product's own limits, degrees;
// negative within them.
struct LegBeyond {
  float thigh, knee;
};
LegBeyond leg_beyond(const HumanPositions& body, size_t side) noexcept;

}  // namespace panache
