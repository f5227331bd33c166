#pragma once
// Hands that meet in a motion meet on a body with other arms and shoulders, too.

#include "rig/body_pose.h"

namespace panache {

// Turns the arms of `change` so that the wrists are as far from each other, in lengths of an arm,
// and in the same direction as in the motion: fully where they are near, not at all from 0.6
// lengths of an arm on, and as far as the arms reach. The hands keep their rotations, and the
// middle between them its place. `joints`: changed_joints() of the body, which it keeps up;
// `between`: from the left to the right wrist in the motion, world, in lengths of an arm of the
// motion's own body; `arm`: of this body, metres. The body's heading frame is the world's.
void meet_hands(const BodyPose& body, Vec3 between, float arm, HumanPositions& joints,
                BodyChange& change) noexcept;

}  // namespace panache
