#pragma once
// How far the joints of people go: the normal ranges of motion that tables of goniometry print
// (American Academy of Orthopaedic Surgeons). Degrees.

namespace panache {

// Ranges of a swing from the limb's neutral direction. Between front, side and back an ellipse
// limits it.
struct SwingRange {
  float front, back;  // Flexion, extension.
  float out, in;      // Abduction, adduction; both sides alike for the torso.
};
inline constexpr SwingRange kTorsoRange = {80, 30, 35, 35};       // Chest on hips, from up.
inline constexpr SwingRange kHeadRange = {45, 45, 45, 45};        // Head on chest, from up.
inline constexpr SwingRange kShoulderRange = {180, 60, 180, 75};  // Upper arm on chest, from down.
inline constexpr SwingRange kHipRange = {120, 30, 45, 30};        // Upper leg on hips, from down.
// Straight up an arm's flexion and abduction meet: where the height of its direction is more than
// this, it is in range whichever way it points; degrees per that height.
inline constexpr float kOverhead = 0.6f, kOverheadSlope = 200;

// Bends of a hinge, and how far it goes the wrong way.
struct HingeRange {
  float most, back;
};
inline constexpr HingeRange kElbowRange = {150, 10}, kKneeRange = {140, 2};
// The cosines of how far a bend is from exactly the wrong way, across the limb, between which it
// begins to count as wrong and counts fully: the rest of the circle is in reach of a twist of the
// upper limb.
inline constexpr float kWrongFrom = 0.26f, kWrongTo = 0.82f;

}  // namespace panache
