#pragma once
// Finds the pose in a file that describes its character best.

#include <utility>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

// The clip for retarget()'s `character`, and its rig: the rest pose if it stands on the floor, else
// the first motion on the joints of `rest`. `motion` may be null.
Result<std::pair<Clip, Rig>> find_body(Clip rest, const Clip* motion, const RigOptions& options);

}  // namespace panache
