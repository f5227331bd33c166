// In the place of fbx.cpp in a build without Assimp.

#include "fbx.h"

namespace panache::cli {

Result<std::string> fbx_to_glb(const std::string& path) {
  return Error{path + ": this build reads no FBX files; build with libassimp-dev"};
}

}  // namespace panache::cli
