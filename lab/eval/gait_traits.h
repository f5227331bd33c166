#pragma once
// What a person sees of a style in a walk: how the limbs move, and which side does what. Unlike a
// classifier, they say how much of a style there is.

#include <array>
#include <vector>

#include "learn/take.h"

namespace panache {

// The movements of a walk, in order.
struct MovementTrait {
  const char* key;    // In report.json.
  const char* label;  // For people, with the unit.
  double visible;     // Smaller differences are not seen.
};
inline constexpr std::array kMovementTraits = std::to_array<MovementTrait>({
    {"knee_lift", "knee lift, degrees", 10},  // 90 % of the thighs' forward angle.
    {"arms_raised", "arms raised, arm lengths",
     0.15},                             // 90 % of the wrists' height over shoulders.
    {"arm_swing", "arm swing, cm", 4},  // Deviation of the wrists fore and aft.
    {"bob", "bob, cm", 1.5},            // Deviation of the height of the hips.
    {"lean", "lean, degrees", 6},       // Median of the forward tilt, hips to neck.
    {"steps", "steps a second", 0.3},   // Of both feet.
    {"hip_height", "height of the hips, leg lengths", 0.06},  // Median.
});
inline constexpr size_t kStepsTrait = 5;
using Movement = std::array<double, kMovementTraits.size()>;

// Of a walking take, without its first 0.4 s, in which strengths ease in. Lengths count as on a leg
// of 0.85 m. NaN throughout for takes of less than a second.
Movement movement_of(const Take& take);

// The difference between a walk and its mirror image, halved, over whole strides: of each joint's
// mean position about the hips (heading frame), then of its deviations, metres. [2][kHumanJoints]
// Empty for takes of less than a second.
using SideVector = std::vector<Vec3>;
SideVector side_of(const Take& take);
// Mean length over the joints' positions, metres; 0 for an empty one.
double side_size(const SideVector& side);

}  // namespace panache
