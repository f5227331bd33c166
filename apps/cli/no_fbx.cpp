// In the place of fbx.cpp in a build without Assimp.

#include "fbx.h"
#include "messages.h"

namespace panache::cli {

Result<FbxAsGlb> fbx_to_glb(const std::string& path) {
  return Error{path + ": this build reads no FBX files; build with libassimp-dev"};
}

int read_fbx_as_child(const std::string& path) {
  print_message(fbx_to_glb(path).error().message);
  return kBadInput;
}

}  // namespace panache::cli
