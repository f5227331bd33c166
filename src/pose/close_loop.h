#pragma once
// Makes the last pose of a clip equal to its first, and repeats cycles.

#include <span>

#include "clip/clip.h"
#include "pose/contacts.h"
#include "pose/root_pose.h"
#include "rig/rig.h"

namespace panache {

// Moves the poses of frame `first` and of the last frame half way to each other, and spreads the
// difference over the frames between: rotations and translations of the body's joints, and tilt and
// height of the hips. The path of the root stays. Feet are adjusted in the air and stay in place on
// the ground; `contacts`: of each frame from `first` on. Joints that are neither part of the body
// nor below the hips stay unchanged.
void close_loop(const Rig& rig, int first, std::span<const FootContacts> contacts, Clip& clip);

// The way from the start of a cycle to its end, `round` times.
class Travel {
 public:
  Travel(const RootPose& begin, const RootPose& end) : begin_(begin), end_(end) {}
  // The turn of the body after these rounds, radians, and the position then of a body starting at
  // `begin`, metres.
  float turned(int round) const noexcept;
  Vec3 position(int round) const noexcept;
  const RootPose& begin() const noexcept { return begin_; }

 private:
  RootPose begin_, end_;
};

// `clip`, followed by its frames after `first` again, each round starting where the last one ended,
// until the motion is repeated `rounds` times. Frame f of round r is frame f + r * (clip.frames - 1
// - first).
Clip repeat_loop(const Clip& clip, const Rig& rig, int first, const Travel& travel, int rounds);

}  // namespace panache
