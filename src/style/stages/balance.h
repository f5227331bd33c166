#pragma once
// A style does not lean until the body would fall.

#include "pose/changed_joints.h"

namespace panache {

// From the middle of ankles and toes to the mean of all joints, in the space of `joints`, metres.
Vec3 centre_over_feet(const HumanPositions& joints) noexcept;

// From mid-hip to mid-shoulder, unit.
Vec3 torso_way(const HumanPositions& joints) noexcept;

// Where a change takes the body's centre (the mean of its joints) further from over its feet than
// the input has it, the upper body turns back about the hips, by no more than the style leans it
// that way: from 8 cm on softly, so that some 12 cm are left of 20. `joints`: changed_joints(),
// which it keeps up. Up to 8 cm nothing happens, to the bit.
void keep_balance(const HeadingBody& body, HumanPositions& joints, BodyChange& change) noexcept;

}  // namespace panache
