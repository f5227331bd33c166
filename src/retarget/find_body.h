#pragma once
// The part of a file that describes its character best.

#include <utility>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

// The clip to hand to retarget() for a character, and its rig: its rest pose, where that is a body
// that stands on the floor; else its first motion, on the joints of `rest`. `motion` may be null.
Result<std::pair<Clip, Rig>> find_body(Clip rest, const Clip* motion, const RigOptions& options);

}  // namespace panache
