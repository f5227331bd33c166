#pragma once
// A style's change of one instant, by name; and the same as a row of numbers, as networks
// answer with it and model files are scaled by it.

#include <array>
#include <span>

#include "rig/humanoid.h"

namespace panache {

// Zero everywhere leaves the instant as it is.
struct StyleDelta {
  // Rotation vectors, heading frame, radians: put on top of each joint's world rotation.
  std::array<Vec3, kHumanJoints> rotations{};
  float hips_height = 0;  // Metres.
  // Over the ground, m/s and radians/s of the input's own time, so that the way is the same at any
  // tempo.
  float velocity_left = 0, velocity_forward = 0;
  float turn_rate = 0;

  static constexpr int kSize = 3 * kHumanJoints + 4;  // Numbers when packed.
};

// The one order of the numbers: as the fields stand above, each rotation as x, y, z.
void pack(const StyleDelta& delta, std::span<float, StyleDelta::kSize> out) noexcept;
StyleDelta unpack(std::span<const float, StyleDelta::kSize> numbers) noexcept;

// Left for right: the same change of the mirrored body.
StyleDelta mirrored(const StyleDelta& delta) noexcept;

}  // namespace panache
