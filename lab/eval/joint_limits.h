#pragma once
// What no human body can do: joints bent beyond the range of motion of people.

#include "rig/humanoid.h"

namespace panache {

// The joint that is furthest beyond its limit, and by how much; 0 degrees where none is.
struct BeyondLimit {
  HumanJoint joint = HumanJoint::hips;
  float degrees = 0;
};

// Looks at spine, head, shoulders, elbows, hips and knees of a canonical body (any place and
// heading) as far as positions show them: how far each limb swings, in which direction, and which
// way elbows and knees bend; no twist.
//
// The limits are what tables of goniometry print as normal ranges of motion (shoulder and elbow:
// those of the American Academy of Orthopaedic Surgeons), plus a margin of 20 degrees, because such
// ranges are means over people who move one joint at a time. Between front, side and back a swing
// is limited by an ellipse.
BeyondLimit beyond_limits(const HumanPositions& body) noexcept;

}  // namespace panache
