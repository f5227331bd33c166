#pragma once
// Makes a motion in place, for games that move the character themselves.

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

// Removes the horizontal path of the body of `clip`, which has the joints of `rig`: hips and joints
// above them keep the horizontal position of the motion's first frame (Rig::first_frame()).
// Heights, rotations and a calibration pose stay. Joints without animated translation stay
// unchanged.
void stay_in_place(const Rig& rig, Clip& clip);

}  // namespace panache
