#pragma once
// How far a limb exceeds the human range of motion.

#include <numbers>

#include "base/vec.h"

namespace panache {

// Ranges of a swing from the limb's neutral direction. The limit is an ellipse between front, side
// and back.
struct SwingRange {
  float front, back;  // Flexion, extension.
  float out, in;      // Abduction, adduction; both sides alike for the torso.
};
inline constexpr SwingRange kTorsoRange = {80, 30, 35, 35};       // Chest on hips, from up.
inline constexpr SwingRange kHeadRange = {45, 45, 45, 45};        // Head on chest, from up.
inline constexpr SwingRange kShoulderRange = {180, 60, 180, 75};  // Upper arm on chest, from down.
inline constexpr SwingRange kHipRange = {120, 30, 45, 30};        // Upper leg on hips, from down.
// Overhead, an arm's flexion and abduction meet: above kOverhead (y of its unit direction) every
// direction is in range; degrees per unit of that height.
inline constexpr float kOverhead = 0.6f, kOverheadSlope = 200;

// The largest bend of a hinge, and how far it bends the wrong way.
struct HingeRange {
  float max, back;
};
inline constexpr HingeRange kElbowRange = {150, 10}, kKneeRange = {140, 2};
// Cosines of the angle around the limb between a bend and the exactly wrong direction, from not
// wrong at all to fully wrong: a twist of the upper limb reaches all other directions.
inline constexpr float kWrongFrom = 0.26f, kWrongTo = 0.82f;

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
