#pragma once
// A style's change of one pose as named fields, and packed in the order of network outputs and of
// the scales in model files.

#include <array>
#include <span>

#include "rig/humanoid.h"

namespace panache {

// Zero everywhere leaves the pose unchanged.
struct StyleDelta {
  // Rotation vectors, heading frame, radians: applied on top of each joint's world rotation.
  std::array<Vec3, kHumanJoints> rotations{};
  float hips_height = 0;  // Metres.
  // Over the ground, m/s and radians/s of input time, so that the way is the same at any tempo.
  float velocity_left = 0, velocity_forward = 0;
  float turn_rate = 0;

  static constexpr int kSize = 3 * kHumanJoints + 4;  // Numbers when packed.
};

// Packs the fields in the order above, each rotation as x, y, z.
void pack(const StyleDelta& delta, std::span<float, StyleDelta::kSize> out) noexcept;
StyleDelta unpack(std::span<const float, StyleDelta::kSize> numbers) noexcept;

// The same change of the mirrored body.
StyleDelta mirrored(const StyleDelta& delta) noexcept;

}  // namespace panache
