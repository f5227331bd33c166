#pragma once
// Finds the joint where a character's rig keeps the path over the ground. Private to the folder.

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

// The character's root joint: above its hips, named so or with vertices of its own, on the floor
// below them at rest; -1 if it has none.
int find_root_joint(const Clip& character, const Rig& rig);

}  // namespace panache
