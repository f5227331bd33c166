#include "style/pose_change.h"

#include "rig/canonical_skeleton.h"

namespace panache {
namespace {

Vec3 mid_hip_of(const PredictedPose& pose) {
  const Vec3 middle = (pose.body[index(HumanJoint::left_upper_leg)] +
                       pose.body[index(HumanJoint::right_upper_leg)]) *
                      0.5f;
  return to_world(middle, pose.root);
}

}  // namespace

Quat joint_rotation(const StyleDelta& change, int joint) noexcept {
  const Vec3 r = change.rotations[joint];
  const float s = dot(r, r) / 4;  // Of the half angle a: a^2.
  if (!(s < 2.5f)) return exp_rotation(r);
  // Half a turn and less: Taylor's series of sin(a) / a and cos(a) in a^2, of which rounding loses
  // more than they leave out, 2.5^8 / 17! = 4e-12 and 2.5^8 / 16! = 7e-11.
  float sine = 1, cosine = 1;
  for (int k = 7; k >= 1; --k) {
    sine = 1 - sine * s * (1.0f / static_cast<float>(2 * k * (2 * k + 1)));
    cosine = 1 - cosine * s * (1.0f / static_cast<float>(2 * k * (2 * k - 1)));
  }
  const Vec3 axis = r * (sine / 2);
  return {axis.x, axis.y, axis.z, cosine};
}

HumanPositions change_body(const HumanPositions& body, const StyleDelta& change) noexcept {
  HumanPositions out;
  out[0] = body[0] + Vec3{0, change.hips_height, 0};
  for (int j = 1; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    out[j] = out[parent] + rotate(joint_rotation(change, parent), body[j] - body[parent]);
  }
  return out;
}

BodyChange change_between(const PredictedPose& before, const PredictedPose& after) noexcept {
  std::array<Quat, kHumanJoints> from, to;
  canonical_frames(before.body, 0, from);
  canonical_frames(after.body, 0, to);
  BodyChange change;
  for (size_t j = 0; j < kHumanJoints; ++j) change.rotations[j] = to[j] * conjugate(from[j]);
  change.turn = after.root.facing - before.root.facing;
  change.translation = mid_hip_of(after) - mid_hip_of(before);
  return change;
}

}  // namespace panache
