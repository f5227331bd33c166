#pragma once
// How far a limb is beyond the range of motion of people. Private to the folder.

#include <numbers>

#include "base/vec.h"
#include "rig/range_of_motion.h"

namespace panache {

constexpr float in_radians(float degrees) { return degrees * std::numbers::pi_v<float> / 180; }

// The limits are the normal ranges of motion and 10 degrees more, as several joints share a
// movement. Radians. Hinges have no margin the wrong way: it is seen at once.
inline constexpr float kRangeMargin = in_radians(10);

// Where a limb may swing from the joint that it hangs on.
struct Swings {
  Vec3 rest;         // Its direction at rest: x out, y up, z ahead.
  SwingRange range;  // Radians.
  float safe;        // Cosine of the narrowest of these: no closer look is needed up to it.
  bool arm = false;  // Overhead an arm goes less far, see kOverhead.
};
constexpr SwingRange in_radians(const SwingRange& range) {
  return {in_radians(range.front), in_radians(range.back), in_radians(range.out),
          in_radians(range.in)};
}
inline constexpr Swings kTorsoSwings = {{0, 1, 0}, in_radians(kTorsoRange), .8660f};
inline constexpr Swings kHeadSwings = {{0, 1, 0}, in_radians(kHeadRange), .7071f};
inline constexpr Swings kShoulderSwings = {{0, -1, 0}, in_radians(kShoulderRange), .5f, true};
inline constexpr Swings kHipSwings = {{0, -1, 0}, in_radians(kHipRange), .8660f};

// How far a unit direction swings beyond, radians; below zero within.
float swing_beyond(Vec3 direction, const Swings& swings) noexcept;

struct Hinge {
  Vec3 bends_to;  // Where the lower limb goes as it bends, with the upper one hanging down.
  float most, back;
  float safe;  // Cosine of a bend of the right way that needs no closer look.
};
inline constexpr Hinge kElbowHinge = {
    {0, 0, 1}, in_radians(kElbowRange.most) + kRangeMargin, in_radians(kElbowRange.back), -.8660f};
inline constexpr Hinge kKneeHinge = {
    {0, 0, -1}, in_radians(kKneeRange.most) + kRangeMargin, in_radians(kKneeRange.back), -.7660f};

struct Bend {
  float angle = 0;  // Radians,
  float wrong = 0;  // and of it the wrong way.
};
// Of unit directions. A hinge bends the wrong way within 35 to 75 degrees of the exactly wrong
// direction.
Bend bend_of(Vec3 upper, Vec3 lower, const Hinge& hinge) noexcept;
// The same, or 0 where it is safe.
Bend unsafe_bend_of(Vec3 upper, Vec3 lower, const Hinge& hinge) noexcept;

}  // namespace panache
