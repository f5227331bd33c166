#pragma once
// A motion on the spot, as games want it that move the character themselves.

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

// Takes the horizontal path off the body of `clip`, which has the joints of `rig`: hips and joints
// above them stay above the place of the first frame of the motion (Rig::first_frame()). Heights
// and rotations stay, and so does a calibration pose. Joints whose translation the clip does not
// animate are left alone.
void stay_in_place(const Rig& rig, Clip& clip);

}  // namespace panache
