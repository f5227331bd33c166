#pragma once
// A style does not fold a body that bends down already, nor press it into the floor.

#include "pose/changed_joints.h"

namespace panache {

// How much of a style a body takes whose input is `world` (canonical metres, floor at 0): all while
// the head is as high as in a squat, nothing where it is near the floor.
float share_above_floor(const HumanPositions& world) noexcept;

// A bent style adds its lean to that of the input: in a squat, a jump or a fall it would take the
// head between the knees or through the floor. The upper body turns back by a share of what the
// torso leans more than in the input: by none of it where that is upright, by all where it bends
// down. `joints`: those of changed_joints(), kept up to date.
void limit_fold(const HeadingBody& body, HumanPositions& joints, BodyChange& change) noexcept;

}  // namespace panache
