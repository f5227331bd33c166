#include "style/pose_change.h"

#include <array>

#include "rig/canonical_skeleton.h"

namespace panache {

ChangeNumbers change_to_pose(std::span<const float> pose, const HumanPositions& body,
                             std::span<const float, kRootNumbers> root) noexcept {
  ChangeNumbers change;
  std::array<Quat, kHumanJoints> before, after;
  canonical_frames(body, 0, before);
  for (int j = 0; j < kHumanJoints; ++j) {
    // Two columns that are nearly unit and at right angles: made so by Gram and Schmidt's method.
    const float* n = &pose[6 * j];
    const Vec3 x = normalized(Vec3{n[0], n[1], n[2]}, Vec3{1, 0, 0});
    const Vec3 raw{n[3], n[4], n[5]};
    const Vec3 other = std::abs(x.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
    const Vec3 y = normalized(raw - x * dot(raw, x), normalized(other - x * dot(other, x)));
    const Quat local = from_axes(x, y, cross(x, y));
    after[j] = kHumanParent[j] < 0 ? local : after[kHumanParent[j]] * local;
    const Vec3 turn = log_rotation(after[j] * conjugate(before[j]));
    change[3 * j] = turn.x;
    change[3 * j + 1] = turn.y;
    change[3 * j + 2] = turn.z;
  }
  change[63] = pose[126] - body[0].y;
  for (int k = 0; k < kRootNumbers; ++k) change[64 + k] = pose[127 + k] - root[k];
  return change;
}

Quat joint_rotation(const ChangeNumbers& change, int joint) noexcept {
  return joint_rotation(unpack(change), joint);
}

Quat joint_rotation(const StyleDelta& delta, int joint) noexcept {
  const Vec3 r = delta.rotations[joint];
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

HumanPositions change_body(const HumanPositions& body, const ChangeNumbers& change) noexcept {
  HumanPositions out;
  out[0] = body[0] + Vec3{0, change[63], 0};
  for (int j = 1; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    out[j] = out[parent] + rotate(joint_rotation(change, parent), body[j] - body[parent]);
  }
  return out;
}

}  // namespace panache
