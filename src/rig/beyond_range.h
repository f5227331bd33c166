#pragma once
// How far a limb exceeds the human range of motion.

#include <numbers>

#include "base/vec.h"
#include "rig/range_of_motion.h"

namespace panache {

constexpr float in_radians(float degrees) { return degrees * std::numbers::pi_v<float> / 180; }

// Limits are the normal ranges of motion plus 10 degrees, as several joints share a movement.
// Radians. Hinges have no margin the wrong way, where any excess is visible.
inline constexpr float kRangeMargin = in_radians(10);

// How far a limb may swing relative to its parent.
struct Swings {
  Vec3 rest;         // Its direction at rest: x out, y up, z ahead.
  SwingRange range;  // Radians.
  float safe;        // Cosine of the narrowest limit: within it no further check is needed.
  bool arm = false;  // Whether kOverhead applies.
};
constexpr SwingRange in_radians(const SwingRange& range) {
  return {in_radians(range.front), in_radians(range.back), in_radians(range.out),
          in_radians(range.in)};
}
inline constexpr Swings kTorsoSwings = {{0, 1, 0}, in_radians(kTorsoRange), .8660f};
inline constexpr Swings kHeadSwings = {{0, 1, 0}, in_radians(kHeadRange), .7071f};
inline constexpr Swings kShoulderSwings = {{0, -1, 0}, in_radians(kShoulderRange), .5f, true};
inline constexpr Swings kHipSwings = {{0, -1, 0}, in_radians(kHipRange), .8660f};

// How far a unit direction exceeds the limit, radians; negative within it.
float swing_beyond(Vec3 direction, const Swings& swings) noexcept;

struct Hinge {
  Vec3 bends_to;  // Direction of the bending lower limb while the upper one hangs down.
  float max, back;
  float safe;  // Cosine of a bend the right way that needs no further check.
};
inline constexpr Hinge kElbowHinge = {
    {0, 0, 1}, in_radians(kElbowRange.max) + kRangeMargin, in_radians(kElbowRange.back), -.8660f};
inline constexpr Hinge kKneeHinge = {
    {0, 0, -1}, in_radians(kKneeRange.max) + kRangeMargin, in_radians(kKneeRange.back), -.7660f};

struct Bend {
  float angle = 0;  // Radians,
  float wrong = 0;  // and its part in the wrong direction.
};
// Takes unit directions. A bend counts as fully wrong within 35 degrees of the exactly wrong
// direction, and not at all beyond 75.
Bend bend_of(Vec3 upper, Vec3 lower, const Hinge& hinge) noexcept;
// The same, or 0 if it is safe.
Bend unsafe_bend_of(Vec3 upper, Vec3 lower, const Hinge& hinge) noexcept;

}  // namespace panache
