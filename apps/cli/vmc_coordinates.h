#pragma once
// Converts between Unity's coordinates, used by VMC (left-handed, Y up, facing +z, left hand at
// -x), and Panache's (right-handed, Y up, facing +z, left hand at +x): mirror images in the plane x
// = 0. Only signs change, so a round trip is exact to the bit.

#include "base/quat.h"
#include "base/vec.h"

namespace panache::cli {

// Both directions, metres.
constexpr Vec3 mirrored_position(Vec3 p) { return {-p.x, p.y, p.z}; }
// Both directions. A mirrored rotation turns about the mirrored axis in the opposite sense.
constexpr Quat mirrored_rotation(Quat q) { return {q.x, -q.y, -q.z, q.w}; }

}  // namespace panache::cli
