#include "eval/systems/yumer2016/signals.h"

#include <numbers>

#include "rig/canonical_body.h"

namespace panache::yumer2016 {
namespace {

// Of a rotation's two rotation vectors, the one closer to `last`.
Vec3 unwrapped(Vec3 rotation, Vec3 last) {
  const float angle = length(rotation);
  if (angle < 1) return rotation;
  const Vec3 other = rotation * (1 - 2 * std::numbers::pi_v<float> / angle);
  return length(other - last) < length(rotation - last) ? other : rotation;
}

Vec3 angle_of(const Signals& signals, int joint) {
  return {signals[3 * joint], signals[3 * joint + 1], signals[3 * joint + 2]};
}

// World rotations in the heading frame.
std::array<Quat, kHumanJoints> frames_of(const Signals& signals) {
  std::array<Quat, kHumanJoints> frames;
  for (int j = 0; j < kHumanJoints; ++j) {
    const Quat local = exp_rotation(angle_of(signals, j));
    frames[j] = j ? frames[kHumanParent[j]] * local : local;
  }
  return frames;
}

}  // namespace

std::vector<Signals> joint_signals(const Take& take) {
  const size_t numbers = take.pose_features.size() / take.body.size();
  std::vector<Signals> all(take.body.size());
  std::array<Quat, kHumanJoints> frames;
  for (size_t f = 0; f < all.size(); ++f) {
    canonical_frames(take.body[f], 0, frames);
    for (int j = 0; j < kHumanJoints; ++j) {
      const Quat local = j ? conjugate(frames[kHumanParent[j]]) * frames[j] : frames[j];
      Vec3 angle = log_rotation(local);
      if (f > 0) angle = unwrapped(angle, angle_of(all[f - 1], j));
      all[f][3 * j] = angle.x, all[f][3 * j + 1] = angle.y, all[f][3 * j + 2] = angle.z;
    }
    all[f][kHipsHeight] = take.body[f][0].y;
    const float* root = &take.pose_features[(f + 1) * numbers - kRootFeatures];
    all[f][kSpeed] = root[kVelocityForward];
  }
  return all;
}

StyleDelta change_of(const Signals& before, const Signals& after) {
  const std::array<Quat, kHumanJoints> from = frames_of(before), to = frames_of(after);
  StyleDelta change;
  for (int j = 0; j < kHumanJoints; ++j) {
    change.rotations[j] = log_rotation(to[j] * conjugate(from[j]));
  }
  change.hips_height = after[kHipsHeight] - before[kHipsHeight];
  change.velocity_forward = after[kSpeed] - before[kSpeed];
  return change;
}

}  // namespace panache::yumer2016
