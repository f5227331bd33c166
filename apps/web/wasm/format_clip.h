#pragma once
// Clips as files for the visitor to keep.

#include <string>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/rig.h"

namespace panache::web {

// The bytes of a new file: BVH for ".bvh", for ".vrma" the motion on that format's own body, else
// GLB with a body. In the pose `reference` nothing is twisted. Fails where the motion cannot be put
// on another body.
Result<std::string> format_clip(const Clip& clip, const Rig& rig, ConstPose reference,
                                const std::string& extension);

}  // namespace panache::web
