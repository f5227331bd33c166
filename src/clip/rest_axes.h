#pragma once
// The same motion on a skeleton whose rest rotations are the identity, which is all that BVH knows.

#include "clip/clip.h"

namespace panache {

// `clip` with the local axes of every joint turned so that the rest pose has no rotations. All
// joints and ends are where they were in the rest pose and in every frame, in the roots' parent
// space; offsets, ends and rotations are expressed in the new axes.
Clip in_rest_axes(const Clip& clip);

}  // namespace panache
