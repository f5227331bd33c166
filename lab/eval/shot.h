#pragma once
// Measures whether contacts of feet, seat and hands are preserved, so that a clip fits its shot.

#include <array>
#include <vector>

#include "learn/take.h"

namespace panache {

// Each measure compares an output with its input in the frames where the input meets a condition.
// The key is that of the report; values are changes in cm unless the name says otherwise.
enum class ShotMeasure {
  standing_toe,   // Height of the toe of a foot that stands still.
  standing_lift,  // Height of the ankle of that foot.
  standing_turn,  // Rotation of that foot about the vertical, degrees.
  walking_toe,    // Height of the toe of a foot on the floor while the hips travel.
  seat_hips,      // Height of hips at rest, low or not above the feet.
  seat_toe,       // Height of the toes then, if they are on the floor.
  hands,          // Distance of wrists within 18 cm of each other.
  hand_head,      // Distance from the head of a wrist within 28 cm of it.
  in_body,        // Penetration of thigh in thigh, shin in shin, forearm in torso, hand in head.
};
inline constexpr std::array<const char*, 9> kShotKeys = {
    "standing_toe", "standing_lift", "standing_turn", "walking_toe", "seat_hips",
    "seat_toe",     "hands",         "hand_head",     "in_body"};

// Values of each measure, one or two per applicable frame; in order of ShotMeasure.
using ShotValues = std::array<std::vector<float>, kShotKeys.size()>;

// Both takes have the same frames.
ShotValues measure_shot(const Take& input, const Take& output);

}  // namespace panache
