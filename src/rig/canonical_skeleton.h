#pragma once
// The canonical body as a skeleton: used by the walker, and to derive joint rotations from
// positions.

#include <array>

#include "base/quat.h"
#include "clip/clip.h"
#include "rig/humanoid.h"

namespace panache {

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
