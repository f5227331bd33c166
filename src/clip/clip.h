#pragma once
// A skeleton and its motion, in the units and axes of the file.
// The rig infers the up axis, the unit and the meaning of joints.

#include <span>
#include <string>
#include <vector>

#include "base/quat.h"
#include "base/vec.h"

namespace panache {

struct Joint {
  std::string name;            // As in the file, prefixes and spaces included.
  int parent = -1;             // Index of the parent, smaller than the joint's own; -1 for a root.
  Vec3 offset;                 // Rest translation from the parent, file units.
  Quat rest;                   // Rest rotation relative to the parent; the identity in BVH.
  bool can_rotate = false;     // The file animates its rotation.
  bool can_translate = false;  // The file animates its translation.
  std::vector<Vec3> ends;      // End Sites: points fixed to the joint, file units.
  std::string role;            // The joint's role according to the file ("leftHand"), or empty.
  int skin = -1;          // The index of the file's skin with vertices that follow it; -1 for none.
  float skin_weight = 0;  // Total weight of the vertices of that skin that follow it.
  // The file's animation leaves it at rest throughout, as if it animated only morph weights or
  // props; always false in formats that hold only the motion of joints.
  bool still = false;
  // The file's animation has no channel of it, unlike others; always false in formats whose motions
  // have all joints.
  bool unkeyed = false;
};

struct Skeleton {
  std::vector<Joint> joints;  // Parents before children.
};

// One instant: the transform of each joint relative to its parent. A view: it does not own its
// arrays.
struct ConstPose {
  std::span<const Quat> rotations;     // [joints], unit
  std::span<const Vec3> translations;  // [joints], file units
};
struct Pose {
  std::span<Quat> rotations;
  std::span<Vec3> translations;
  operator ConstPose() const { return {rotations, translations}; }
};

// Poses at a constant rate.
struct Clip {
  Skeleton skeleton;
  double frame_time = 1.0 / 30;  // Seconds between frames, above zero.
  int frames = 0;
  std::vector<Quat> rotations;     // [frames][joints]
  std::vector<Vec3> translations;  // [frames][joints]

  size_t joints() const { return skeleton.joints.size(); }
  double duration() const { return frames * frame_time; }  // Seconds.
  ConstPose pose(int frame) const;
  Pose pose(int frame);
  // Makes room for `count` frames; new ones are undefined.
  void resize(int count);
  // Adds a frame.
  void append(ConstPose pose);
};

// One frame of the skeleton at rest.
Clip rest_clip(const Skeleton& skeleton);

// Forward kinematics: `world` gets the joints of `local` in the space of the roots' parent, file
// units. Both have the skeleton's joints, and may share arrays. Allocates nothing.
void world_pose(const Skeleton& skeleton, ConstPose local, Pose world) noexcept;
// The same for one joint, whose parent (-1: none) has been placed.
inline void place_joint(int joint, int parent, ConstPose local, Pose world) noexcept {
  const auto j = static_cast<size_t>(joint), p = static_cast<size_t>(parent);
  if (parent < 0) {
    world.rotations[j] = local.rotations[j];
    world.translations[j] = local.translations[j];
    return;
  }
  world.translations[j] = world.translations[p] + rotate(world.rotations[p], local.translations[j]);
  // Rounding changes the length of a product a little; over a deep chain that would add up.
  world.rotations[j] = normalized(world.rotations[p] * local.rotations[j]);
}

// Whether the joint leaves its rest position in any frame.
bool leaves_rest_position(const Clip& clip, size_t joint);

// Sets `still` for each joint that stays at rest in all frames of `clip`, up to rounding. The rest
// pose is that of its skeleton.
void mark_still_joints(Clip& clip);

// The pose at `frame` (fractional, clamped to the clip): rotations along the shorter arc,
// translations linear. Whole frames are returned bit for bit, and so are joints that are equal in
// the frames on both sides. The clip has at least one frame; `out` has the clip's joints. Allocates
// nothing.
void sample(const Clip& clip, double frame, Pose out);

// The same motion as BVH requires it: `clip` with the local axes of every joint rotated so that the
// rest pose has no rotations. The positions of joints and ends are unchanged in the rest pose and
// in every frame, in the space of the roots' parent; offsets, ends and rotations are expressed in
// the new axes.
Clip in_rest_axes(const Clip& clip);

}  // namespace panache
