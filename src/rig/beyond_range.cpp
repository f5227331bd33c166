#include "rig/beyond_range.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "base/quat.h"

namespace panache {
namespace {

// The direction in which a hinge bends.
struct BendDirection {
  float off, along;  // The lower limb's components across and along the upper one.
  float wrong;       // 0 to 1.
};
BendDirection bend_direction(Vec3 upper, Vec3 lower, const Hinge& hinge) {
  const Vec3 to = rotate(rotation_between(Vec3{0, -1, 0}, upper), hinge.bends_to);
  const Vec3 bend = lower - upper * dot(upper, lower);
  const float off = length(bend);
  const float wrong =
      off > 1e-6f ? smooth_step((-dot(bend, to) / off - kWrongFrom) / (kWrongTo - kWrongFrom))
                  : 0.0f;
  return {off, dot(upper, lower), wrong};
}

Bend bend_of(const BendDirection& direction) {
  const float angle = arc_tangent(direction.off, direction.along);
  return {angle, angle * direction.wrong};
}

}  // namespace

float swing_beyond(Vec3 direction, const Swings& swings) noexcept {
  const SwingRange& range = swings.range;
  const float across = std::sqrt(direction.x * direction.x + direction.z * direction.z);
  float beyond = -in_radians(90);
  if (!(across < 1e-6f)) {
    const float ahead = direction.z / across / (direction.z > 0 ? range.front : range.back);
    const float out = direction.x / across / (direction.x > 0 ? range.out : range.in);
    const float max = 1 / std::sqrt(ahead * ahead + out * out) + kRangeMargin;
    beyond = arc_tangent(across, dot(direction, swings.rest)) - max;
  }
  if (!swings.arm) return beyond;
  return std::min(beyond, in_radians(kOverheadSlope) * (kOverhead - direction.y));
}

Bend bend_of(Vec3 upper, Vec3 lower, const Hinge& hinge) noexcept {
  return bend_of(bend_direction(upper, lower, hinge));
}

Bend unsafe_bend_of(Vec3 upper, Vec3 lower, const Hinge& hinge) noexcept {
  const BendDirection direction = bend_direction(upper, lower, hinge);
  return direction.wrong == 0 && direction.along > hinge.safe ? Bend{} : bend_of(direction);
}

}  // namespace panache
