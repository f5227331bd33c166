#pragma once
// Makes the last pose of a clip its first one again, and goes through a cycle more than once.

#include <span>

#include "clip/clip.h"
#include "pose/contacts.h"
#include "pose/root_pose.h"
#include "rig/rig.h"

namespace panache {

// Brings the poses of frame `first` and of the last one together, each half of the way, and spreads
// that over the frames between them: rotations and translations of the body's joints, and tilt and
// height of the hips. The path of the root stays. Feet are brought along while they are in the air
// and stay where they stand; `contacts`: of each frame from `first` on. Joints that the hips do not
// carry, and that are not part of the body, are left alone.
void close_loop(const Rig& rig, int first, std::span<const FootContacts> contacts, Clip& clip);

// The way from where a cycle begins to where it ends, gone `round` times.
class Travel {
 public:
  Travel(const RootPose& begin, const RootPose& end) : begin_(begin), end_(end) {}
  // How far the body is turned by then, radians, and where what was at `begin` is, metres.
  float turned(int round) const noexcept;
  Vec3 position(int round) const noexcept;
  const RootPose& begin() const noexcept { return begin_; }

 private:
  RootPose begin_, end_;
};

// `clip` up to its last frame, then the frames after `first` again, each round where the one before
// it ended, until its motion is there `rounds` times. Frame f of round r is the frame
// f + r * (clip.frames - 1 - first).
Clip repeat_loop(const Clip& clip, const Rig& rig, int first, const Travel& travel, int rounds);

}  // namespace panache
