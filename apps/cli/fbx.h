#pragma once
// FBX files, which come in through Assimp (Open Asset Import Library) and go on as GLB.

#include <string>
#include <vector>

#include "base/result.h"

namespace panache::cli {

struct FbxAsGlb {
  std::string glb;
  std::vector<std::string> notes;  // As MotionFile::notes().
};

// The GLB that holds what Assimp understands of the FBX file at `path`: the tree of nodes, meshes,
// skins, materials and animations, in metres with +Y up. Pictures that are neither in the file nor
// where it says, nor beside it, become white. Of a file that Assimp does not read there are no
// meshes (fbx_scene.h); a note says so where it has some.
//
// Assimp's readers have a history of memory errors, so they run in a process of their own with
// bounds on memory and time, which can reach neither files nor networks (sandbox.h): whatever a
// damaged file does to it ends as a message. A build without Assimp has only a message too.
Result<FbxAsGlb> fbx_to_glb(const std::string& path);

// The first argument that makes this program the process that reads the file named by the second,
// and what it does then; returns the exit code. Nobody else has a use for it.
inline constexpr const char* kFbxReader = "--read-fbx-for-parent";
int read_fbx_as_child(const std::string& path);

}  // namespace panache::cli
