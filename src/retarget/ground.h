#pragma once
// A body on the ground as another one is: feet as high, planted where the motion plants them, no
// toe under the floor.

#include <array>
#include <vector>

#include "pose/contacts.h"
#include "pose/changed_joints.h"

namespace panache {

// One frame of a body that follows a motion.
struct GroundedFrame {
  BodyChange change;
  // Where the toes are in the motion, above its floor: world, in the size of this body, metres.
  std::array<Vec3, kFeet> toes;
  FootContacts contacts;  // In the motion.
};

// Lifts or lowers the body so that the feet that are near the floor are as high as in the motion.
// `body`: what the change is of, its floor at 0; its heading frame is the world's.
void match_heights(const BodyPose& body, GroundedFrame& frame) noexcept;

// Bends the legs so that a planted foot moves exactly as in the motion, and lifts the body,
// smoothly and ahead of time, where a toe would go under the floor. Frames are `seconds` apart.
void hold_feet(const HeadingBody& body, float seconds, std::vector<GroundedFrame>& frames);

}  // namespace panache
