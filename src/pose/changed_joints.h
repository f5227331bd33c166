#pragma once
// Where a change puts the joints, and how far below the floor.

#include "pose/contacts.h"
#include "rig/body_pose.h"

namespace panache {

Vec3 mid_hip(const BodyPose& body) noexcept;  // World.

// A body and how its joints lie in its heading frame: origin midway between the hip joints, axes
// turned so that the body faces +z.
struct HeadingBody : BodyPose {
  HeadingBody(const BodyPose& body) noexcept;  // Implicit, because it is the same body.
  Quat to_heading;                             // From the world's axes.
  HumanPositions ways;  // From the parents of `joints` to them, and from the origin to the hips.
};

// Positions of the user's joints with the rotations of `change` on them, in the heading frame of
// the input. Turn and translation are left out.
void changed_joints(const HeadingBody& body, const BodyChange& change,
                    HumanPositions& out) noexcept;
// The same of the legs alone, after rotations of leg joints; what is above them stays in `out`.
void changed_legs(const HeadingBody& body, const BodyChange& change, HumanPositions& out) noexcept;

// The height below which a style should put no toe: the floor, or the input's own lowest toe where
// that is lower. World, metres.
float toe_floor(const BodyPose& body) noexcept;
// How much deeper than that the lowest toe is with `change`; 0 above it. `joints`:
// changed_joints().
float floor_depth(const BodyPose& body, const HumanPositions& joints,
                  const BodyChange& change) noexcept;

}  // namespace panache
