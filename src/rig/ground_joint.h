#pragma once
// The joint that carries a body's path over the ground. Private to the folder.

#include "clip/clip.h"
#include "rig/calibration.h"

namespace panache {

// The lowest joint above the hips that moves along the ground in the clip and takes the hips along,
// as root motion of games does; -1 if the hips move by themselves.
int find_ground_joint(const Clip& clip, int hips, const Calibration& calibration);

}  // namespace panache
