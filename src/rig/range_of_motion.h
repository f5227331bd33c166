#pragma once
// The normal human ranges of motion from goniometry tables (American Academy of Orthopaedic
// Surgeons). Degrees.

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

}  // namespace panache
