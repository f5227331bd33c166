#pragma once
// A style's change of one pose as named fields, and packed in the order of network outputs and of
// the scales in model files; and how it sets the feet on the ground.

#include <array>
#include <span>

#include "pose/contacts.h"
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

// A style's change of a standing foot; zero keeps it.
struct Stance {
  float heel = 0;                   // How far the heel is lifted about the toes, radians.
  std::array<float, kFeet> turn{};  // About +y, radians.
};

// `mean`: the style's mean change. Only styles on tiptoe lift heels: in other styles a small mean
// lift comes from their steps.
Stance stance_of(const StyleDelta& mean) noexcept;

}  // namespace panache
