#pragma once
// The skeleton and the motions of FBX files that Assimp does not read.

#include <memory>
#include <string>
#include <string_view>

#include <assimp/scene.h>

#include "base/result.h"

namespace panache::cli {

// A scene as Assimp makes them, of the models and motions of FBX in text form, of version 6 or 7;
// meshes and all else are left out. `path` stands in front of messages. Null where there is no
// model.
Result<std::unique_ptr<aiScene>> fbx_text_scene(std::string_view text, const std::string& path);

}  // namespace panache::cli
