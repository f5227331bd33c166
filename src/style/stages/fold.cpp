#include "style/stages/fold.h"

#include <algorithm>
#include <cmath>

#include "base/smooth_step.h"
#include "style/stages/balance.h"

namespace panache {
namespace {

using enum HumanJoint;

// Radians from upright: a lean that is not touched, and how much more it may come to at most.
constexpr float kFreeLean = 0.9f, kLeanRoom = 0.5f;

constexpr float kLowHead = 0.3f, kHighHead = 0.7f;  // Metres; 1.5 where the body stands.

constexpr float kRounding = 1e-3f;  // Radians: an unchanged body is left alone to the bit.

float lean(Vec3 torso) { return arc_tangent(std::hypot(torso.x, torso.z), torso.y); }

}  // namespace

float share_above_floor(const HumanPositions& world) noexcept {
  return smooth_step((world[index(head)].y - kLowHead) / (kHighHead - kLowHead));
}

void limit_fold(const BodyPose& body, HumanPositions& joints, BodyChange& change) noexcept {
  const Vec3 now = torso_way(joints);
  const float leans = lean(now), over = leans - kFreeLean;
  if (!(over > 0)) return;
  // Begins without a kink, and ends at kLeanRoom.
  const float soft = kFreeLean + over * kLeanRoom / (over + kLeanRoom);
  const float back = leans - std::max(soft, lean(torso_way(body.joints)) + kRounding);
  if (!(back > 0)) return;
  const Quat turn = axis_angle(normalized(cross(now, Vec3{0, 1, 0})), back);
  for (int j = index(hips); j <= index(right_hand); ++j) {
    change.rotations[j] = normalized(turn * change.rotations[j]);
  }
  changed_joints(body, change, joints);
}

}  // namespace panache
