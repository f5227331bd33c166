#include "style/stages/reach.h"

#include <algorithm>

#include "base/easing.h"
#include "base/elementary.h"
#include "pose/limb.h"
#include "pose/two_bone.h"

namespace panache {
namespace {

// Cosines of the arm's turn at which the elbow no longer follows the style, and still fully does.
constexpr float kFarTurn = 0, kNearTurn = 0.85f;
constexpr float kElbowSeconds = 0.1f;  // Time constant of the elbow's side,
constexpr float kElbowRate = 5;        // and how fast it turns about its arm at most, rad/s.

}  // namespace

void reach(int side, Vec3 target, Vec3 elbow, const StepTime& time, ArmSide& last,
           HumanPositions& joints, BodyChange& change) noexcept {
  const LimbJoints arm = arm_joints(side);
  const Vec3 root = joints[arm.root], end = joints[arm.end];
  const Vec3 from = normalized(end - root), to = normalized(target - root);
  const Quat swing = rotation_between(from, to);
  const float own = smooth_step((dot(from, to) - kFarTurn) / (kNearTurn - kFarTurn));
  const Vec3 style = rotate(swing, normalized(bend_of(root, joints[arm.middle], end, arm.hint)));
  const Vec3 input = normalized(bend_of(root, elbow, target, arm.hint));
  const Vec3 wanted = normalized(lerp(input, style, own), input);
  if (last.side == Vec3{}) last = {style, to};
  const Vec3 carried = rotate(rotation_between(last.way, to), last.side);
  const Vec3 now = normalized(carried - to * dot(carried, to), style);
  const float turn = arc_tangent(dot(cross(now, wanted), to), dot(now, wanted));
  const float max = kElbowRate * time.output;
  last = {rotate(axis_angle(to, std::clamp(turn * time.gain(kElbowSeconds), -max, max)), now), to};
  aim_limb(arm, target, last.side, joints, change);
}

}  // namespace panache
