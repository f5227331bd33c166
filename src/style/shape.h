#pragma once
// How much is given of what a style does.

#include <array>

#include "rig/humanoid.h"

namespace panache {

// Parts of the body that can get more or less of a style, each relative to what it hangs on.
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

// With all at 1 a style acts as the model has it, bit for bit. Each is held within 0 to kMax; a
// number that is not finite counts as 1.
struct Shape {
  static constexpr float kMax = 2;

  float strength = 1;  // Of all styles together.
  float posture = 1;   // Of the lasting part of the change: its mean over the last second or so.
  float dynamics = 1;  // Of what the change is beyond that, and of the root motion.
  float timing = 1;    // Of the logarithm of the rate.
  // Legs include hips, height and root motion; the torso includes the head.
  std::array<float, kRegions> regions = {1, 1, 1, 1};
  float foot_lock = 1;  // How firmly planted feet are held, 0 to 1.

  friend bool operator==(const Shape&, const Shape&) = default;
};

// Every style as it was captured.
inline constexpr Shape kPlainShape;

}  // namespace panache
