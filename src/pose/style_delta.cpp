#include "pose/style_delta.h"

namespace panache {

void pack(const StyleDelta& delta, std::span<float, StyleDelta::kSize> out) noexcept {
  float* number = out.data();
  for (const Vec3& r : delta.rotations) {
    for (const float v : {r.x, r.y, r.z}) *number++ = v;
  }
  for (const float v :
       {delta.hips_height, delta.velocity_left, delta.velocity_forward, delta.turn_rate}) {
    *number++ = v;
  }
}

StyleDelta unpack(std::span<const float, StyleDelta::kSize> numbers) noexcept {
  StyleDelta delta;
  const float* number = numbers.data();
  for (Vec3& r : delta.rotations) {
    for (float* v : {&r.x, &r.y, &r.z}) *v = *number++;
  }
  for (float* v :
       {&delta.hips_height, &delta.velocity_left, &delta.velocity_forward, &delta.turn_rate}) {
    *v = *number++;
  }
  return delta;
}

StyleDelta mirrored(const StyleDelta& delta) noexcept {
  StyleDelta other = delta;
  for (int j = 0; j < kHumanJoints; ++j) {
    // Reflecting x keeps the turn about x and reverses the others.
    const Vec3 r = delta.rotations[j];
    other.rotations[kHumanMirror[j]] = {r.x, -r.y, -r.z};
  }
  other.velocity_left = -delta.velocity_left;
  other.turn_rate = -delta.turn_rate;
  return other;
}

namespace {

constexpr float kMinHeel = 0.17f;  // Radians; the next style to those on tiptoe has 0.15.

}  // namespace

Stance stance_of(const StyleDelta& mean) noexcept {
  Stance stance;
  float heel = 0;
  for (size_t f = 0; f < kFeet; ++f) {
    const Vec3 turn = mean.rotations[index(kAnkles[f])];
    heel += turn.x / kFeet;
    stance.turn[f] = turn.y;
  }
  if (heel > kMinHeel) stance.heel = heel;
  return stance;
}

}  // namespace panache
