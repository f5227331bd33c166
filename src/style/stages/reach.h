#pragma once
// Moves a wrist to keep a contact, and chooses the side of the elbow.

#include "pose/changed_joints.h"
#include "style/stages/step_time.h"

namespace panache {

// The side of an elbow, and the direction from shoulder to wrist: unit vectors, heading frame; 0
// without a contact.
struct ArmSide {
  Vec3 side, way;
};

// Moves a wrist to `target`. The elbow keeps the style's side; the further the arm turns, the more
// it takes that of `elbow`, its position in the input, because a large turn makes the style's side
// arbitrary. `last` starts on the style's side, follows the arm, and turns about it towards the
// chosen side. `joints`: changed_joints() with `change`; updates the arm.
void reach(int side, Vec3 target, Vec3 elbow, const StepTime& time, ArmSide& last,
           HumanPositions& joints, BodyChange& change) noexcept;

}  // namespace panache
