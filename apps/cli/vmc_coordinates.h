#pragma once
// VMC speaks in Unity's coordinates (left-handed, Y up, facing +z, the left hand at -x), Panache in
// its own (right-handed, Y up, facing +z, the left hand at +x): mirror images in the plane x = 0.
// Only signs change, so that a number that goes there and back is the same to the bit.

#include "base/quat.h"
#include "base/vec.h"

namespace panache::cli {

// Either way, metres.
constexpr Vec3 mirrored_position(Vec3 p) { return {-p.x, p.y, p.z}; }
// Either way. A mirrored rotation turns about the mirrored axis in the opposite sense.
constexpr Quat mirrored_rotation(Quat q) { return {q.x, -q.y, -q.z, q.w}; }

}  // namespace panache::cli
