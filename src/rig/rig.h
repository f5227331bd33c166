#pragma once
// How one skeleton is a humanoid, and how poses travel between it and the canonical body.

#include <array>
#include <string>
#include <vector>

#include "base/quat.h"
#include "base/result.h"
#include "clip/clip.h"
#include "rig/humanoid.h"

namespace panache {

// One instant of the user's character brought to the canonical body.
struct BodyPose {
  HumanPositions positions;                 // World, Y up, metres, canonical proportions, floor at 0.
  std::array<Quat, kHumanJoints> rotations; // World rotations of the user's joints turned Y up, in
                                            // their raw local axes: only their changes mean anything.
                                            // A missing joint carries its nearest mapped ancestor's.
  HumanPositions joints;                    // World positions of the user's own joints, Y up, metres
                                            // (own proportions, scaled), floor at 0; a missing joint
                                            // carries its nearest mapped ancestor's.
  float facing = 0;                         // Heading about +y, radians; 0 faces +z. Not unwrapped.
};

// What a style does to one instant.
struct BodyChange {
  // World rotations in the heading frame of the input (origin facing +z), applied on top of each
  // joint's world rotation; the identity leaves the joint alone.
  std::array<Quat, kHumanJoints> rotations;
  float turn = 0;    // Then the whole body turns by this about +y through its hips, radians.
  Vec3 translation;  // And moves by this, world, Y up, canonical metres.
};

class Rig {
 public:
  // Finds the humanoid in the skeleton of `clip`, and units, up axis, floor, first usable frame and
  // toes from its poses. The sentence of a failure says which joints were not found and names those
  // that were seen. A clip needs at least one frame.
  static Result<Rig> create(const Clip& clip);

  // skeleton joint of each human joint, -1 where the skeleton has none.
  const std::array<int, kHumanJoints>& joints() const { return joint_of_; }
  // How each was found, for people ("name", "parent of leftHand", "missing", ...).
  const std::array<std::string, kHumanJoints>& reasons() const { return reasons_; }
  const std::string& up_axis() const { return up_axis_; }  // "+Y", "-Z", ...
  float scale() const { return scale_; }                   // Canonical metres per file unit.
  int first_frame() const { return first_frame_; }         // 1 where the first is a calibration pose.
  const std::vector<std::string>& notes() const { return notes_; }

  // The user's pose on the canonical body. Allocates nothing, never fails: finite in, finite out.
  void read(ConstPose pose, BodyPose& out) noexcept;

  // The user's pose with `change` on it. `in` and `body` are those of the last read(), whose forward
  // kinematics it reuses. Where the change is the identity, `out` is `in` bit for bit. Joints that are
  // not part of the humanoid keep their local rotation. Allocates nothing, never fails.
  void write(ConstPose in, const BodyPose& body, const BodyChange& change, Pose out) noexcept;
};

}  // namespace panache
