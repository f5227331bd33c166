#pragma once
// Keeps a style from leaning so far that the body would fall.

#include "pose/changed_joints.h"

namespace panache {

// From the middle of ankles and toes to the mean of all joints, in the space of `joints`, metres.
Vec3 centre_over_feet(const HumanPositions& joints) noexcept;

// From mid-hip to mid-shoulder, unit.
Vec3 torso_way(const HumanPositions& joints) noexcept;

// If a change moves the body's centre (the mean of its joints) horizontally away from its feet, the
// upper body turns back about the hips, by no more than the style leans it that way: softly beyond
// 8 cm, so that 20 cm become about 12. Up to 8 cm nothing changes at all. `joints`:
// changed_joints(); updated. `amount`: how active any style is.
void keep_balance(const HeadingBody& body, float amount, HumanPositions& joints,
                  BodyChange& change) noexcept;

}  // namespace panache
