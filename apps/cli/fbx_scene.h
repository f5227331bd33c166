#pragma once
// Scenes of FBX files: what Assimp makes of them, and what is read of those that it does not read.

#include <memory>
#include <string>
#include <string_view>

#include <assimp/scene.h>

#include "base/result.h"

namespace panache::cli {

struct FbxScene {
  std::unique_ptr<aiScene> scene;  // As Assimp makes them; null where there is no model.
  bool lacks_meshes = false;       // The file has some, and the scene none.
};

// The models and motions of FBX in text form, of version 6 or 7; meshes and all else are left out.
// `path` stands in front of messages.
Result<FbxScene> fbx_text_scene(std::string_view text, const std::string& path);

// Makes a scene ready for glTF: puts the file's unit and axes on the root, so that the whole is in
// metres with +Y up; lets skinned joints rest as their skin was bound; takes keys out of the
// animations that say nothing; brings all meshes to one bind pose, as Assimp writes all of them
// with one skin; puts the scales of nodes into the places below them; and lets each corner of a
// skin follow at most four joints, with weights that sum to one.
void repair_scene(aiScene& scene);

}  // namespace panache::cli
