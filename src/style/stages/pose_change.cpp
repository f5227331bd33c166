#include "style/stages/pose_change.h"

#include <span>

#include "rig/canonical_body.h"

namespace panache {
namespace {

Vec3 mid_hip_of(const PredictedPose& pose) {
  const Vec3 middle = (pose.body[index(HumanJoint::left_upper_leg)] +
                       pose.body[index(HumanJoint::right_upper_leg)]) *
                      0.5f;
  return to_world(middle, pose.root);
}

// Converts rotation vectors to rotations. All at once, because compilers vectorise such loops;
// results are bit-identical.
template <size_t n>
void rotations_of(std::span<const Vec3, n> vectors, std::span<Quat, n> out) {
  std::array<float, n> s, sine, cosine;
  for (size_t j = 0; j < n; ++j)
    s[j] = dot(vectors[j], vectors[j]) / 4;  // a^2 of the half angle a.
  sine.fill(1);
  cosine.fill(1);
  // Half a turn and less: Taylor's series of sin(a) / a and cos(a) in a^2, of which rounding loses
  // more than they leave out, 2.5^8 / 17! = 4e-12 and 2.5^8 / 16! = 7e-11.
  for (int k = 7; k >= 1; --k) {
    const float sine_factor = 1.0f / static_cast<float>(2 * k * (2 * k + 1));
    const float cosine_factor = 1.0f / static_cast<float>(2 * k * (2 * k - 1));
    for (size_t j = 0; j < n; ++j) {
      sine[j] = 1 - sine[j] * s[j] * sine_factor;
      cosine[j] = 1 - cosine[j] * s[j] * cosine_factor;
    }
  }
  for (size_t j = 0; j < n; ++j) {
    const Vec3 axis = vectors[j] * (sine[j] / 2);
    out[j] = s[j] < 2.5f ? Quat{axis.x, axis.y, axis.z, cosine[j]} : exp_rotation(vectors[j]);
  }
}

}  // namespace

Quat joint_rotation(const StyleDelta& change, int joint) noexcept {
  Quat rotation;
  rotations_of(std::span(change.rotations).subspan(static_cast<size_t>(joint)).first<1>(),
               std::span<Quat, 1>(&rotation, 1));
  return rotation;
}

std::array<Quat, kHumanJoints> joint_rotations(const StyleDelta& change) noexcept {
  std::array<Quat, kHumanJoints> out;
  rotations_of(std::span(change.rotations), std::span(out));
  return out;
}

HumanPositions change_body(const HumanPositions& body, const StyleDelta& change) noexcept {
  HumanPositions out;
  out[0] = body[0] + Vec3{0, change.hips_height, 0};
  const std::array<Quat, kHumanJoints> rotations = joint_rotations(change);
  for (int j = 1; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    out[j] = out[parent] + rotate(rotations[parent], body[j] - body[parent]);
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
