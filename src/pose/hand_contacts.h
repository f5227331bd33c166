#pragma once
// Keeps contacts of hands with each other or the body on a changed body.

#include <array>

#include "pose/limb.h"

namespace panache {

// How much hands keep contacts, 0 (none) to 1 (fully).
struct HandHolds {
  std::array<float, 2> by_body{};  // Left and right wrist with the body.
  float together = 0;              // With each other.
};

// The contact of wrists at a distance in arm lengths: 1 if the hands touch or hold one thing, 0 if
// they are unrelated, smooth between.
float hands_nearness(float arm_lengths) noexcept;

// Moves the vector from the left to the right wrist towards `between` by the share `amount`, of
// which the right wrist moves `of_right`, both 0 to 1.
void bring_together(Vec3 between, float amount, float of_right, Vec3& left, Vec3& right) noexcept;

}  // namespace panache
