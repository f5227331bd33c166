#pragma once
// Brings a wrist to where hands keep a contact, and decides which way the elbow goes.

#include "pose/changed_joints.h"
#include "style/stages/step_time.h"

namespace panache {

// The side of its arm to which an elbow went, and the direction from shoulder to wrist: unit
// vectors, heading frame; 0 without a contact.
struct ArmSide {
  Vec3 side, way;
};

// Brings a wrist to `target`, with the elbow on the style's side; or on that of `elbow`, where the
// input has it, the more, the further the arm turns: what is left of a side after that is chance.
// `last` starts on the style's side, goes along with the arm, and turns about it towards that side.
// `joints`: changed_joints() with `change`, of which it keeps up the arm.
void reach(int side, Vec3 target, Vec3 elbow, const StepTime& time, ArmSide& last,
           HumanPositions& joints, BodyChange& change) noexcept;

}  // namespace panache
