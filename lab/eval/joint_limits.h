#pragma once
// Detects joints bent beyond the human range of motion.

#include "rig/humanoid.h"

namespace panache {

// The joint that exceeds its limit most, and by how much; 0 degrees if none does.
struct BeyondLimit {
  HumanJoint joint = HumanJoint::hips;
  float degrees = 0;
};

// Checks spine, head, shoulders, elbows, hips and knees of a canonical body (any position and
// heading) as far as positions show them: the angle and direction of each limb's swing, and the
// direction in which elbows and knees bend; not twist.
// The limits are normal ranges of motion from goniometry tables (shoulder and elbow: those of the
// American Academy of Orthopaedic Surgeons) plus 20 degrees, because these are means over people
// who move one joint at a time. Between front, side and back, swings are limited by an ellipse.
BeyondLimit beyond_limits(const HumanPositions& body) noexcept;

}  // namespace panache
