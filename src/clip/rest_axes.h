#pragma once
// The same motion on a skeleton whose rest rotations are the identity, as BVH requires.

#include "clip/clip.h"

namespace panache {

// `clip` with the local axes of every joint rotated so that the rest pose has no rotations. The
// positions of joints and ends are unchanged in the rest pose and in every frame, in the space of
// the roots' parent; offsets, ends and rotations are expressed in the new axes.
Clip in_rest_axes(const Clip& clip);

}  // namespace panache
