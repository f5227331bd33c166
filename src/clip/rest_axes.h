#pragma once
// The same motion on the skeleton that BVH has for it.

#include "clip/clip.h"

namespace panache {

// `clip` with the local axes of every joint turned so that the rest pose has no rotations. All
// joints and ends are where they were in the rest pose and in every frame, in the roots' parent
// space; offsets, ends and rotations are expressed in the new axes.
Clip in_rest_axes(const Clip& clip);

// `clip` without a root that is no joint of the body but the scene around it, as an outer node of a
// glTF file: its only child becomes the root, with all joints where they were. A root that the file
// animates or that a skin follows stays.
Clip without_still_root(Clip clip);

}  // namespace panache
