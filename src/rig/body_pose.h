#pragma once
// The pose of a body at one instant, and a change of it.

#include <array>

#include "base/quat.h"
#include "rig/humanoid.h"

namespace panache {

// The pose of the user's character at one instant, retargeted to the canonical body.
struct BodyPose {
  // World, Y up, metres, canonical proportions, floor at 0.
  HumanPositions positions;
  // World rotations of the user's left and right hand, Y up, in their raw local axes: only their
  // changes are meaningful. A missing hand has the rotation of its nearest mapped ancestor.
  std::array<Quat, 2> hands;
  // World positions of the user's own joints, Y up, metres (own proportions, scaled), above the
  // same floor, with the mid-hip of `positions`. Missing hands and toes are estimated; any other
  // missing joint has the position of its nearest mapped ancestor.
  HumanPositions joints;
  // Heading about +y, radians; 0 faces +z. Not unwrapped.
  float facing = 0;
};

// A BodyPose with more data for retargeting and learning; a step does not need it.
struct RotatedBodyPose : BodyPose {
  // Like `hands`, but for every joint.
  std::array<Quat, kHumanJoints> rotations;
};

// A style's change of one pose.
struct BodyChange {
  // World rotations in the heading frame of the input (origin facing +z), applied on top of each
  // joint's world rotation; the identity leaves the joint alone.
  std::array<Quat, kHumanJoints> rotations;
  float turn = 0;    // Then the whole body turns by this about +y through its hips, radians.
  Vec3 translation;  // And moves by this, world, Y up, canonical metres.
};

}  // namespace panache
