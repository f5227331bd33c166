#pragma once
// The amounts of a style's effects, and the range of its tempo.

#include <algorithm>
#include <array>

#include "rig/humanoid.h"

namespace panache {

// Parts of the body that can get more or less of a style, each relative to its parent.
enum class Region { legs, torso, left_arm, right_arm };
inline constexpr int kRegions = 4;
inline constexpr std::array<const char*, kRegions> kRegionNames = {"legs", "torso", "left_arm",
                                                                   "right_arm"};
// The hips belong to the legs, the head to the torso.
constexpr Region region_of(int joint) {
  using enum HumanJoint;
  if (joint == index(hips) || joint >= index(left_upper_leg)) return Region::legs;
  if (joint <= index(head)) return Region::torso;
  return joint < index(right_shoulder) ? Region::left_arm : Region::right_arm;
}

// With all at 1 the style is unchanged, bit for bit. Each is clamped to 0 to kMax; numbers that are
// not finite count as 1.
struct Shape {
  static constexpr float kMax = 2;

  float strength = 1;  // Amount of all styles.
  float posture = 1;   // Amount of the change's mean over about the last second.
  float dynamics = 1;  // Amount of the rest of the change and of the root motion.
  float timing = 1;    // Factor of the logarithm of the rate.
  // Legs include hips, height and root motion; the torso includes the head.
  std::array<float, kRegions> regions = {1, 1, 1, 1};
  float foot_lock = 1;      // How firmly planted feet are held, 0 to 1.
  float hand_contacts = 1;  // How firmly hands keep what they touch, 0 to 1.
  // Amount of the input's own movement of torso, head and arms around its mean over the last
  // seconds; without a style, too.
  float energy = 1;

  friend bool operator==(const Shape&, const Shape&) = default;
};

// The amount of the legs.
inline float legs_of(const Shape& shape) noexcept {
  return shape.regions[static_cast<size_t>(Region::legs)];
}

// Every style as it was captured.
inline constexpr Shape kPlainShape;

// Half to double tempo, as the logarithm of input seconds per output second.
inline constexpr float kMaxLogRate = 0.7f;

inline float bounded_log_rate(float log_rate) noexcept {
  return std::clamp(log_rate, -kMaxLogRate, kMaxLogRate);
}

}  // namespace panache
