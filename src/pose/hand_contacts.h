#pragma once
// Hands that touch each other or the body in a motion touch it on a changed body as well.

#include <array>

#include "pose/limb.h"

namespace panache {

// How much hands keep contacts, 0 (none) to 1 (fully).
struct HandHolds {
  std::array<float, 2> by_body{};  // Left and right wrist, by the part of the body that they touch.
  float together = 0;              // By each other.
};

// How near wrists are that are so many lengths of an arm apart: 1 where the hands touch or hold one
// thing, 0 where they have nothing to do with each other, smooth between.
float hands_nearness(float arm_lengths) noexcept;

// Moves wrists so that the right one is nearer to being `between` from the left one: by the share
// `amount`, of which the right one moves `of_right`, both 0 to 1.
void bring_together(Vec3 between, float amount, float of_right, Vec3& left, Vec3& right) noexcept;

}  // namespace panache
