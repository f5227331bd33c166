#pragma once
// What of a pose may be believed.

#include <algorithm>
#include <cassert>
#include <cmath>

#include "clip/clip.h"

namespace panache {

// Takes over what is a rotation and a place in `in`; where it is none, `kept` stays. Also guards
// against numbers so large that products overflow.
inline void take_sound(ConstPose in, Pose kept) noexcept {
  assert(in.rotations.size() == kept.rotations.size());
  for (size_t j = 0; j < kept.rotations.size(); ++j) {
    const Quat q = in.rotations[j];
    const Vec3 t = in.translations[j];
    if (is_finite(q) && std::abs(dot(q, q) - 1) < 0.1f) kept.rotations[j] = q;
    if (is_finite(t) && std::max({std::abs(t.x), std::abs(t.y), std::abs(t.z)}) < 1e9f) {
      kept.translations[j] = t;
    }
  }
}

}  // namespace panache
