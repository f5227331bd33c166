#pragma once
// Contacts: planted feet in motion, and hands with each other or the body.

#include <algorithm>
#include <array>
#include <vector>

#include "rig/humanoid.h"

namespace panache {

inline constexpr int kFeet = 2;  // Left, right.
inline constexpr std::array<HumanJoint, kFeet> kUpperLegs = {HumanJoint::left_upper_leg,
                                                             HumanJoint::right_upper_leg};
inline constexpr std::array<HumanJoint, kFeet> kLowerLegs = {HumanJoint::left_lower_leg,
                                                             HumanJoint::right_lower_leg};
inline constexpr std::array<HumanJoint, kFeet> kAnkles = {HumanJoint::left_foot,
                                                          HumanJoint::right_foot};
inline constexpr std::array<HumanJoint, kFeet> kToes = {HumanJoint::left_toes,
                                                        HumanJoint::right_toes};

inline constexpr float kAnkleHeight = 0.07f;  // Minimum for a standing foot; metres.

// Height of the lowest foot: its toe, or its ankle minus kAnkleHeight. Metres above the floor of
// `body`.
inline float lowest_foot(const HumanPositions& body) noexcept {
  const auto height = [&](int f) {
    return std::min(body[index(kToes[f])].y, body[index(kAnkles[f])].y - kAnkleHeight);
  };
  return std::min(height(0), height(1));
}

using FootContacts = std::array<bool, kFeet>;

// Contacts of a whole motion: world positions (Y up, metres, floor at 0) at `fps` frames a second.
// A foot is planted while its toe is low and nearly at rest.
std::vector<FootContacts> detect_contacts(const std::vector<HumanPositions>& world, double fps);

// The probability that a foot is planted, from the network's `probability` and the height of its
// toe in the input (metres above the floor): a foot in the air is not planted, whatever the rest of
// the body does.
float planted_near_floor(float probability, float toe_height) noexcept;

// How much hands keep contacts, 0 (none) to 1 (fully).
struct HandHolds {
  std::array<float, 2> by_body{};  // Left and right wrist with the body.
  float together = 0;              // With each other.
};

// The contact of wrists at a distance in arm lengths: 1 if the hands touch or hold one thing, 0 if
// they are unrelated, smooth between.
float hands_nearness(float arm_lengths) noexcept;

// Moves the vector from the left to the right wrist towards `between` by the share `amount`, of
// which the right wrist moves `of_right`, both 0 to 1.
void bring_together(Vec3 between, float amount, float of_right, Vec3& left, Vec3& right) noexcept;

}  // namespace panache
