#pragma once
// Files whose deforming joints are in pieces.
//
// Control rigs (Rigify's, say) move the joints that deform a mesh by constraints. Exporters bake
// those, and leave the joints where they are in the rig's tree: legs and arms as children of its
// root or of controls, beside the spine instead of below it. Moving such hips moves no leg. Here
// the same motion stands on one tree of the deforming joints alone, made from what moves together;
// what is edited there comes back to the file's own tree.

#include <memory>

#include "clip/motion_file.h"

namespace panache {

// `file` itself where its deforming joints hang together. Else a file whose clips have alone those
// of the character with most vertices, in one tree; they are in the same places in every frame. An
// edited frame that equals the one that it came from is written as that one was; all joints that
// deform nothing follow their own parents as before.
std::unique_ptr<MotionFile> join_deforming_joints(std::unique_ptr<MotionFile> file);

}  // namespace panache
