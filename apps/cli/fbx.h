#pragma once
// Turns FBX files into GLB: meshes by Assimp (Open Asset Import Library), nodes and motions by our
// own reader (clip/fbx.h).

#include <string>
#include <vector>

#include "base/result.h"

namespace panache::cli {

struct FbxAsGlb {
  std::string glb;
  std::vector<std::string> notes;  // See MotionFile::notes().
};

// The GLB of the FBX file at `path`: nodes, meshes, skins, materials and animations, in metres with
// +Y up. Pictures found neither in the file, nor at their path, nor next to the file become white.
// Meshes that Assimp cannot read are left out, with a note.
//
// Assimp's readers have a history of memory errors, so they run in a child process with limits on
// memory and time and no access to files or networks (sandbox.h): a damaged file can only cost the
// meshes. A build without Assimp always fails with a message.
Result<FbxAsGlb> fbx_to_glb(const std::string& path);

// The argument that makes this program the child process that reads the file named by the next
// argument, and the child's main function; returns the exit code. For internal use only.
inline constexpr const char* kFbxReader = "--read-fbx-for-parent";
int read_fbx_as_child(const std::string& path);

}  // namespace panache::cli
