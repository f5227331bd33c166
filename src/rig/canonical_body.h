#pragma once
// Puts the canonical body into the pose of another one: canonical lengths along the other's
// directions.

#include <array>
#include <optional>

#include "base/quat.h"
#include "rig/humanoid.h"

namespace panache {

// The humanoid joints of a skeleton; constant over its motion. Always present: the hips, upper and
// lower parts of all four limbs, and the feet. Hands and toes always have positions.
struct BodyShape {
  std::array<bool, kHumanJoints> has{};
  bool chest_at_shoulders = false;  // The chest is between the shoulders and bends nothing.
};

// joints: the user's own, Y up, metres of a body with canonical legs. toes[left, right]: unit
// directions from foot to toes. Mid-hip stays where it is; limbs keep their exact directions; the
// torso's curve is resampled at the canonical fractions.
HumanPositions canonical_positions(const HumanPositions& joints, const BodyShape& shape,
                                   const std::array<Vec3, 2>& toes) noexcept;

// The heading about +y of a body, in radians, 0 facing +z; nothing if hips and shoulders have no
// horizontal axis, as when the body lies on its side. joints as above.
std::optional<float> facing_of(const HumanPositions& joints) noexcept;

// The orthonormal frame (columns) with x along `left`, and y as near to `up` as that allows.
struct Frame {
  Vec3 x, y, z;
  Vec3 operator()(Vec3 v) const { return x * v.x + y * v.y + z * v.z; }
};
Frame frame_of(Vec3 left, Vec3 up) noexcept;

}  // namespace panache
