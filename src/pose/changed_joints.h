#pragma once
// Positions of the joints after a change, and their depth below the floor.

#include "pose/contacts.h"
#include "rig/humanoid.h"

namespace panache {

Vec3 mid_hip(const BodyPose& body) noexcept;  // World.

// A body with its joints in its heading frame: origin midway between the hip joints, the body
// facing +z.
struct HeadingBody : BodyPose {
  HeadingBody(const BodyPose& body) noexcept;  // Implicit, because it is the same body.
  Quat to_heading;                             // From the world's axes.
  HumanPositions offsets;  // From each joint's parent to it; hips: from the origin.
};

// Positions of the user's joints with the rotations of `change`, in the heading frame of the input,
// without its turn and translation.
void changed_joints(const HeadingBody& body, const BodyChange& change,
                    HumanPositions& out) noexcept;
// The same for the legs only, after a change of their rotations; other joints in `out` stay.
void changed_legs(const HeadingBody& body, const BodyChange& change, HumanPositions& out) noexcept;

// The lowest height for toes: the floor, or the input's lowest toe if that is lower. World, metres.
float toe_floor(const BodyPose& body) noexcept;
// The depth of the lowest toe below toe_floor() with `change`, 0 above it. `joints`:
// changed_joints().
float floor_depth(const BodyPose& body, const HumanPositions& joints,
                  const BodyChange& change) noexcept;

}  // namespace panache
