#include "style/stages/shaping.h"

#include <algorithm>

#include "style/stages/pose_change.h"

namespace panache {
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
