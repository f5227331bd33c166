#pragma once
// Files whose deforming joints are not in one tree.
//
// Control rigs (such as Rigify) move the joints that deform a mesh by constraints. Exporters bake
// those and leave the joints where they are in the rig's tree: legs and arms are children of its
// root or of controls, not of the spine. Moving such hips moves no leg. Here the same motion is on
// one tree of the deforming joints only, derived from what moves together; edits are written back
// to the file's own tree.

#include <memory>

#include "clip/motion_file.h"

namespace panache {

// Returns `file` itself if its deforming joints are connected. Otherwise a file whose clips have
// only the deforming joints of the character with the most vertices, in one tree and with the same
// positions in every frame. An edited frame equal to its source is written as in the file; joints
// that deform nothing follow their own parents as before.
std::unique_ptr<MotionFile> join_deforming_joints(std::unique_ptr<MotionFile> file);

}  // namespace panache
