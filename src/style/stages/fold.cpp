#include "style/stages/fold.h"

#include <algorithm>
#include <cmath>

#include "base/easing.h"
#include "pose/changed_joints.h"
#include "style/stages/balance.h"

namespace panache {
namespace {

using enum HumanJoint;

// Radians from upright: an input that leans less than the first gets all of a style's lean, one
// that leans more than the second nothing.
constexpr float kUprightLean = 0.35f, kBentLean = 1.2f;
constexpr float kLowHead = 0.25f, kHighHead = 0.5f;  // Metres; 1.5 where the body stands.

constexpr float kRounding = 1e-3f;  // Radians: below it nothing changes at all.

float lean(Vec3 torso) { return arc_tangent(std::hypot(torso.x, torso.z), torso.y); }

}  // namespace

float share_above_floor(const HumanPositions& world) noexcept {
  return smooth_step((world[index(head)].y - kLowHead) / (kHighHead - kLowHead));
}

void limit_fold(const HeadingBody& body, float amount, HumanPositions& joints,
                BodyChange& change) noexcept {
  const float own = lean(torso_way(body.joints));
  if (own <= kUprightLean) return;
  const Vec3 now = torso_way(joints);
  const float added = lean(now) - own - kRounding;
  const float back =
      amount * added * smooth_step((own - kUprightLean) / (kBentLean - kUprightLean));
  if (!(back > 0)) return;
  const Quat turn = axis_angle(normalized(cross(now, Vec3{0, 1, 0})), back);
  for (int j = index(hips); j <= index(right_hand); ++j) {
    change.rotations[j] = normalized(turn * change.rotations[j]);
  }
  changed_joints(body, change, joints);
}

}  // namespace panache
