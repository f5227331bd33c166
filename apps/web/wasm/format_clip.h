#pragma once
// Clips as files for the visitor to keep.

#include <string>

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache::web {

// The bytes of a new file: BVH for ".bvh", else GLB.
std::string format_clip(const Clip& clip, const Rig& rig, const std::string& extension);

}  // namespace panache::web
