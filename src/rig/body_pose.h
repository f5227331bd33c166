#pragma once
// One instant of a body, and a change of it.

#include <array>

#include "base/quat.h"
#include "rig/humanoid.h"

namespace panache {

// One instant of the user's character brought to the canonical body.
struct BodyPose {
  // World, Y up, metres, canonical proportions, floor at 0.
  HumanPositions positions;
  // World rotations of the user's left and right hand turned Y up, in their raw local axes: only
  // their changes mean anything. A missing hand carries its nearest mapped ancestor's.
  std::array<Quat, 2> hands;
  // World positions of the user's own joints, Y up, metres (own proportions, scaled), above the
  // same floor; mid-hip is that of `positions`. Missing hands and toes are where they would be; any
  // other missing joint carries its nearest mapped ancestor's.
  HumanPositions joints;
  // Heading about +y, radians; 0 faces +z. Not unwrapped.
  float facing = 0;
};

// The same with what retargeting and learning read beyond it, and no step does.
struct RotatedBodyPose : BodyPose {
  // Of each joint what `hands` are of the hands.
  std::array<Quat, kHumanJoints> rotations;
};

// A style's change of one instant.
struct BodyChange {
  // World rotations in the heading frame of the input (origin facing +z), applied on top of each
  // joint's world rotation; the identity leaves the joint alone.
  std::array<Quat, kHumanJoints> rotations;
  float turn = 0;    // Then the whole body turns by this about +y through its hips, radians.
  Vec3 translation;  // And moves by this, world, Y up, canonical metres.
};

}  // namespace panache
