#pragma once
// What Assimp makes of an FBX file, made ready for glTF.

#include <assimp/scene.h>

namespace panache::cli {

// Puts the file's unit and axes on the root, so that the whole is in metres with +Y up; lets
// skinned joints rest as their skin was bound; takes keys out of the animations that say nothing;
// brings all meshes to one bind pose, as Assimp writes all of them with one skin; puts the scales
// of nodes into the places below them; and lets each corner of a skin follow at most four joints,
// with weights that sum to one.
void repair_scene(aiScene& scene);

}  // namespace panache::cli
