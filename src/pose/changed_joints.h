#pragma once
// Where a change puts the joints, and how far below the floor.

#include "pose/contacts.h"
#include "rig/body_pose.h"

namespace panache {

// Positions of the user's joints with the rotations of `change` on them, in the heading frame of
// the input: origin midway between the hip joints, axes turned so that the body faces +z. Turn and
// translation are left out.
Vec3 mid_hip(const BodyPose& body) noexcept;  // World.
void changed_joints(const BodyPose& body, const BodyChange& change, HumanPositions& out) noexcept;

// The height below which a style should put no toe: the floor, or the input's own lowest toe where
// that is lower. World, metres.
float toe_floor(const BodyPose& body) noexcept;
// How much deeper than that the lowest toe is with `change`; 0 above it. `joints`:
// changed_joints().
float floor_depth(const BodyPose& body, const HumanPositions& joints,
                  const BodyChange& change) noexcept;

}  // namespace panache
