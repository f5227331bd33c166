#pragma once
// Scenes of FBX files, read by Assimp or, if Assimp cannot read them, by our own parser.

#include <memory>
#include <string>
#include <string_view>

#include <assimp/scene.h>

#include "base/result.h"

namespace panache::cli {

struct FbxScene {
  std::unique_ptr<aiScene> scene;  // As Assimp builds them; null if there is no model.
  bool lacks_meshes = false;       // The file has meshes, but the scene has none.
};

// The models and motions of FBX text, version 6 or 7, without meshes. Messages begin with `path`.
Result<FbxScene> fbx_text_scene(std::string_view text, const std::string& path);

// Prepares a scene for glTF: puts the file's unit and axes on the root (metres, +Y up); sets the
// rest pose of skinned joints to the bind pose; removes redundant animation keys; gives all meshes
// one bind pose, as Assimp writes them with one skin; bakes node scales into the transforms below;
// and limits each vertex to four joints, with weights that sum to one.
void repair_scene(aiScene& scene);

}  // namespace panache::cli
