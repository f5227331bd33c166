#pragma once
// What has to stay where it is for a clip to fit into a shot: feet, seats and hands that touch.

#include <array>
#include <vector>

#include "learn/take.h"

namespace panache {

// A measure compares an output with its input in the frames where the input does something. Its key
// is that of the report; unless its name says otherwise, values are changes in cm.
enum class ShotMeasure {
  standing_toe,   // Height of the toe of a foot that stands still.
  standing_lift,  // How much higher the ankle of that foot is.
  standing_turn,  // How far that foot is turned about the vertical, degrees.
  walking_toe,    // Height of the toe of a foot on the floor while the hips travel.
  seat_hips,      // Height of hips that rest low or beyond the feet.
  seat_toe,       // Height of the toes meanwhile, where they are on the floor.
  hands,          // Distance of wrists that are within 18 cm of each other.
  hand_head,      // Distance of a wrist that is within 28 cm of the head from it.
  in_body,  // How much deeper thigh is in thigh, shin in shin, forearm in torso, hand in head.
};
inline constexpr std::array<const char*, 9> kShotKeys = {
    "standing_toe", "standing_lift", "standing_turn", "walking_toe", "seat_hips",
    "seat_toe",     "hands",         "hand_head",     "in_body"};

// Values of a measure, one or two for each frame where it applies; in order of ShotMeasure.
using ShotValues = std::array<std::vector<float>, kShotKeys.size()>;

// Both takes have the same frames.
ShotValues measure_shot(const Take& input, const Take& output);

}  // namespace panache
