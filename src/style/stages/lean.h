#pragma once
// Keeps a style from leaning so far that the body would fall, and from folding or pressing into the
// floor a body that already bends down.

#include "pose/changed_joints.h"

namespace panache {

// From the middle of ankles and toes to the mean of all joints, in the space of `joints`, metres.
Vec3 centre_over_feet(const HumanPositions& joints) noexcept;

// From mid-hip to mid-shoulder, unit.
Vec3 torso_direction(const HumanPositions& joints) noexcept;

// If a change moves the body's centre (the mean of its joints) horizontally away from its feet, the
// upper body turns back about the hips, by no more than the style leans it that way: softly beyond
// 8 cm, so that 20 cm become about 12. Up to 8 cm nothing changes at all. `joints`:
// changed_joints(); updated. `amount`: how active any style is.
void keep_balance(const HeadingBody& body, float amount, HumanPositions& joints,
                  BodyChange& change) noexcept;

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
