#pragma once
// The skeleton and the motions of FBX files that Assimp does not read.

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

}  // namespace panache::cli
