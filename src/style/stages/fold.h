#pragma once
// Keeps a style from folding a body that already bends down, and from pressing it into the floor.

#include "pose/changed_joints.h"

namespace panache {

// The share of a style that suits the input `world` (canonical metres, floor at 0): 1 while the
// head is at least as high as in a squat, 0 near the floor.
float share_above_floor(const HumanPositions& world) noexcept;

// A bent style adds its lean to the input's: in a squat, a jump or a fall it would push the head
// between the knees or through the floor. Turns the upper body back by a share of the torso's added
// lean: 0 if the input is upright, 1 if it bends down. `joints`: changed_joints(); updated.
// `amount`: how active any style is.
void limit_fold(const HeadingBody& body, float amount, HumanPositions& joints,
                BodyChange& change) noexcept;

}  // namespace panache
