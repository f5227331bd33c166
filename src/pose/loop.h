#pragma once
// Whether a clip is a loop: its last pose is its first, wherever the body has gone meanwhile.

#include "base/result.h"
#include "clip/clip.h"
#include "pose/root_pose.h"
#include "rig/rig.h"

namespace panache {

// The difference between the last pose of a clip and the first one of its motion.
struct LoopSeam {
  int first = 0, last = 0;  // Frames: the cycle is between them.
  RootPose begin, end;      // Where the body stands and looks there.
  // How far apart the joints of the canonical body are in the two poses, each seen from its own
  // root: in the mean and at most, metres. `extent`: the largest mean of any pose from the first.
  float gap = 0, worst = 0, extent = 0;
  // How fast the body passes the seam: of each joint, seen from the root, the mean of the
  // velocities before and after it; the mean of their lengths, m/s. A body that turns back there
  // has none.
  float speed = 0;

  int frames() const { return last - first; }
};

// `rig`: of `clip`, which has a frame at least. The motion begins at Rig::first_frame().
LoopSeam measure_seam(const Clip& clip, const Rig& rig);

// Whether the clip is a loop: authored ones end in their first pose, and one that is cut from
// captured motion ends near it and goes on as it began.
bool is_loop(const LoopSeam& seam, double frame_time) noexcept;

// Fails where no loop can be made of the clip: it is too short, or its last pose is too far from
// its first.
Result<void> check_closable(const LoopSeam& seam, double frame_time);

}  // namespace panache
