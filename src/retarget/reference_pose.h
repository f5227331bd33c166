#pragma once
// How a rig's joints are turned when its body stands in a T-pose: what makes the rotations of two
// rigs comparable, whatever their rest poses and local axes.

#include <array>

#include "base/quat.h"
#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

struct ReferencePose {
  // World rotations of the human joints, Y up, in their raw local axes, of the body that faces +z
  // with arms along x, legs straight down and feet flat and pointing ahead. A missing joint carries
  // its parent's.
  std::array<Quat, kHumanJoints> rotations;
  // The rest pose stands, so it is the start; otherwise the motion decides.
  bool from_rest = false;
  float leg = 0, arm = 0;  // Both parts of one, mean of both sides, metres of the rig.
  // Height of the toe joints on the floor, metres of the rig: at rest, where the body stands near
  // the origin's plane in that, and where the motion has them lowest. A motion of one frame says
  // nothing; then the plane itself.
  float rest_toes = 0, motion_toes = 0;
};

// How the torso of a canonical body is turned, by the places of its joints: that is the same for
// all rigs, wherever theirs bend.
struct TorsoFrames {
  Quat hips;  // World, the identity for a body that stands upright and faces +z.
  // Unit directions from spine to chest, from chest to the middle of the shoulders, and from neck
  // to head.
  Vec3 spine, chest, neck;
};
// positions, facing: as in BodyPose.
TorsoFrames torso_frames(const HumanPositions& positions, float facing);

// The reference pose from the rest pose of `clip`, where its body stands in that, with its limbs
// brought into the T-pose by the smallest rotations; else of its motion, by the directions of its
// limbs and the mean of their twists.
ReferencePose find_reference_pose(const Clip& clip, const Rig& rig);

}  // namespace panache
