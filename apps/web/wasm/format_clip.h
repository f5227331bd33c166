#pragma once
// Clips as files for the visitor to keep.

#include <string>

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache::web {

// The bytes of a new file: BVH for ".bvh", else GLB with a body. In the pose `reference` nothing is
// twisted.
std::string format_clip(const Clip& clip, const Rig& rig, ConstPose reference,
                        const std::string& extension);

}  // namespace panache::web
