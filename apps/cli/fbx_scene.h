#pragma once
// What Assimp makes of an FBX file, made ready for glTF.

#include <assimp/scene.h>

namespace panache::cli {

// Puts the file's unit and axes on the root, so that the whole is in metres with +Y up; lets
// skinned joints rest as their skin was bound; takes keys out of the animations that say nothing;
// and brings all meshes to one bind pose, as Assimp writes all of them with one skin.
void repair_scene(aiScene& scene);

}  // namespace panache::cli
