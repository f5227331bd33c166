#pragma once
// Detects loops: clips whose last pose is their first, except for the body's travel. A live stream
// has no seam: style/play/playback.cpp searches it for two similar moments instead.

#include <span>

#include "base/result.h"
#include "clip/clip.h"
#include "pose/contacts.h"
#include "pose/features.h"
#include "rig/rig.h"

namespace panache {

// The difference between the last pose of a clip and the first one of its motion.
struct LoopSeam {
  int first = 0, last = 0;  // Frames: the cycle is between them.
  RootPose begin, end;      // Position and heading at both.
  // Mean and largest distance of the canonical joints between the two poses, each relative to its
  // root, metres. `extent`: the largest mean distance of any pose from the first.
  float gap = 0, worst = 0, extent = 0;
  // The mean distances between the first two poses, and the last two; metres.
  float first_step = 0, last_step = 0;
  // The speed at the seam: for each joint, relative to the root, the mean of the velocities before
  // and after; then the mean of their lengths, m/s. It is 0 for a body that reverses there.
  float speed = 0;

  int frames() const { return last - first; }
};

// `rig`: of `clip`, which has at least one frame. The motion begins at Rig::first_frame().
LoopSeam measure_seam(const Clip& clip, const Rig& rig);

// Whether the clip is a loop: authored loops end in their first pose, loops cut from captured
// motion end near it and continue as they began.
bool is_loop(const LoopSeam& seam, double frame_time) noexcept;

// Fails if the clip cannot be made a loop: it is too short, or its last pose is too far from its
// first.
Result<void> check_closable(const LoopSeam& seam, double frame_time);

// Makes the last pose of a clip equal to its first, and repeats cycles.

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
