#pragma once
// A gait as Fourier series over the cycle of two steps, whose coefficients are polynomials of
// speed, turn and acceleration.

#include <array>
#include <span>
#include <vector>

#include "rig/humanoid.h"

namespace panache {

inline constexpr int kHarmonics = 6;
inline constexpr int kWaves = 1 + 2 * kHarmonics;  // 1, then cosine and sine of each harmonic.
inline constexpr int kTerms = 6;  // 1, u, u^2, turn, turn^2, acceleration; see gait_terms.

// The joints that a gait turns; the others of the canonical skeleton keep their parent's frame.
inline constexpr std::array<HumanJoint, 16> kDriven = {HumanJoint::hips,
                                                       HumanJoint::spine,
                                                       HumanJoint::chest,
                                                       HumanJoint::neck,
                                                       HumanJoint::left_shoulder,
                                                       HumanJoint::left_upper_arm,
                                                       HumanJoint::left_lower_arm,
                                                       HumanJoint::right_shoulder,
                                                       HumanJoint::right_upper_arm,
                                                       HumanJoint::right_lower_arm,
                                                       HumanJoint::left_upper_leg,
                                                       HumanJoint::left_lower_leg,
                                                       HumanJoint::left_foot,
                                                       HumanJoint::right_upper_leg,
                                                       HumanJoint::right_lower_leg,
                                                       HumanJoint::right_foot};

// One instant of a gait: the hips' position from the ground point of the path (left, up, ahead;
// metres), then the rotation vectors of kDriven, radians: the hips in the frame of the path's
// heading, the others relative to their parents.
inline constexpr int kChannels = 3 + 3 * static_cast<int>(kDriven.size());
using Channels = std::array<float, kChannels>;

// The same pose with left and right exchanged.
Channels mirrored(const Channels& channels) noexcept;

// A body's motion along its path, smoothed over the steps.
struct Going {
  float speed = 0;         // m/s
  float turn = 0;          // rad/s, to the left.
  float acceleration = 0;  // m/s^2
};

struct Gait {
  float reference = 0;              // m/s; u is the speed minus this.
  float slowest = 0, fastest = 0;   // m/s; the learnt range, to which u^2 is limited.
  float cadence = 0, exponent = 0;  // Cycles a second: cadence * speed ^ exponent.
  float gaze_lead = 0;              // Seconds by which the facing leads the path.
  // Phases at which the left foot lands and lifts at the reference speed, and their change with the
  // speed: radians and radians per m/s. The right foot's are half a cycle later.
  std::array<float, 2> lands{}, lifts{};
  std::vector<float> coefficients;  // [kChannels][kWaves][kTerms]
};

void gait_terms(const Gait& gait, const Going& going, std::span<float, kTerms> terms) noexcept;
void gait_waves(float phase, std::span<float, kWaves> waves) noexcept;

// The pose at `phase` (radians; at 0 the left ankle is furthest ahead of the right).
void evaluate(const Gait& gait, float phase, const Going& going, Channels& out) noexcept;
// Cycles of two steps a second, at any speed above zero.
float cadence(const Gait& gait, float speed) noexcept;
// How far the body would move over its standing foot in a cycle, metres, if all of it were like the
// middle of the stance; at `speed`, without turning.
float distance_over_foot(const Gait& gait, float speed);

}  // namespace panache
