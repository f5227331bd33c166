#pragma once
// Puts a body on the ground as in the source motion: feet at the same height, planted where the
// motion plants them, no toe below the floor.

#include <array>
#include <vector>

#include "pose/contacts.h"
#include "pose/changed_joints.h"

namespace panache {

// One frame of a body that follows a motion.
struct GroundedFrame {
  BodyChange change;
  // Positions of the toes in the motion, above its floor: world, scaled to this body, metres.
  std::array<Vec3, kFeet> toes;
  FootContacts contacts;  // In the motion.
};

// Lifts or lowers the body so that feet near the floor are as high as in the motion. `body`: the
// body before the change, floor at 0, heading frame equal to the world's.
void match_heights(const BodyPose& body, GroundedFrame& frame) noexcept;

// Bends the legs so that a planted foot moves exactly as in the motion, and lifts the body,
// smoothly and ahead of time, where a toe would go under the floor. Frames are `seconds` apart.
void hold_feet(const HeadingBody& body, float seconds, std::vector<GroundedFrame>& frames);

}  // namespace panache
