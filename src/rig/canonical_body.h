#pragma once
// The canonical body: as a skeleton, used by the walker and to derive joint rotations from
// positions; and put into the pose of another body, with canonical lengths along the other's
// directions.

#include <array>
#include <optional>

#include "base/quat.h"
#include "clip/clip.h"
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

// The canonical body in T-pose: the 21 joints in their order under their VRM names, metres, Y up,
// facing +z, arms along x, toes on the ground at y = 0. Rest rotations are the identity, all joints
// rotate, the hips also move; hands, toes and head end in End Sites.
Skeleton canonical_skeleton();

// World rotations of that skeleton that give it the pose of `positions` (21 joints of a canonical
// body, at any position, with the heading `facing`). Hips and chest take their frame from the axis
// between the legs or arms; any other joint is its parent's frame turned by the smallest rotation
// that points it at its child; head, hands and toes keep their parent's frame. Smooth: no signs
// flip as long as the hips stay within half a turn of `facing`.
void canonical_frames(const HumanPositions& positions, float facing,
                      std::array<Quat, kHumanJoints>& world) noexcept;

}  // namespace panache
