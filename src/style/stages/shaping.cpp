#include "style/stages/shaping.h"

#include <algorithm>
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

namespace {

// Long enough for a cycle of two steps to cancel out of the mean, mostly.
constexpr float kPostureSeconds = 0.8f;
constexpr float kNear = 1e-7f;

// A joint's part of the change is its turn relative to its parent.
void weigh_regions(const Shape& shape, std::array<Quat, kHumanJoints>& rotations) {
  if (shape.regions == Shape{}.regions) return;
  const std::array<Quat, kHumanJoints> whole = rotations;
  for (int j = 0; j < kHumanJoints; ++j) {
    const float weight = shape.regions[static_cast<size_t>(region_of(j))];
    const int parent = kHumanParent[j];
    const Quat own = parent < 0 ? whole[j] : conjugate(whole[parent]) * whole[j];
    const Quat weighed = exp_rotation(log_rotation(own) * weight);
    rotations[j] = parent < 0 ? weighed : normalized(rotations[parent] * weighed);
  }
}

}  // namespace

// The root motion is a sum over time: what is held back now stays held back, so that the character
// does not jump.
RootOffset Shaping::hold_back(const Shape& shape, const RootOffset& root,
                              const StepTime& time) noexcept {
  const float held = 1 - std::min(1.0f, shape.dynamics * legs_of(shape));
  if (!time.first) {
    held_.translation += (root.translation - last_.translation) * held;
    held_.turn += (root.turn - last_.turn) * held;
  }
  last_ = root;
  return {root.translation - held_.translation, root.turn - held_.turn};
}

// The mean is always updated, so that it is ready when the shape changes.
StyleDelta Shaping::weigh_in_time(const Shape& shape, const StyleDelta& delta,
                                  const StepTime& time) noexcept {
  const float gain = time.gain(kPostureSeconds);
  const bool whole = shape.posture == 1 && shape.dynamics == 1;
  StyleDelta out = delta;
  const auto weigh = [&](float& mean, float& number) {
    approach(mean, number, gain, kNear);
    if (!whole) number = mean * shape.posture + (number - mean) * shape.dynamics;
  };
  for (size_t j = 0; j < kHumanJoints; ++j) {
    weigh(mean_rotations_[j].x, out.rotations[j].x);
    weigh(mean_rotations_[j].y, out.rotations[j].y);
    weigh(mean_rotations_[j].z, out.rotations[j].z);
  }
  weigh(mean_height_, out.hips_height);
  return out;
}

RootOffset Shaping::step(const Shape& shape, const StyleDelta& delta, const RootOffset& root,
                         const StepTime& time, BodyChange& out) noexcept {
  const RootOffset given = hold_back(shape, root, time);
  const StyleDelta shaped = weigh_in_time(shape, delta, time);
  out.rotations = joint_rotations(shaped);
  weigh_regions(shape, out.rotations);
  out.turn = given.turn;
  out.translation = given.translation + Vec3{0, shaped.hips_height * legs_of(shape), 0};
  return given;
}

}  // namespace panache
