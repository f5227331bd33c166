#pragma once
// All nodes of an FBX file and how they move, for programs that show its meshes.

#include <map>
#include <string>
#include <vector>

#include "base/quat.h"
#include "base/result.h"

namespace panache {

// A transform relative to the parent, in the file's unit: scale, then rotation, then translation.
// Products of them place each node where InheritType does; its axes are those of InheritType, or
// where those are sheared, the nearest.
struct FbxTransform {
  Vec3d translation;
  Quatd rotation;
  Vec3d scale = {1, 1, 1};
};

struct FbxSceneNode {
  std::string name;       // Unique, and as joints are called (clip/fbx.h).
  std::string file_name;  // As in the file, perhaps that of others too.
  int parent = -1;        // An index smaller than the node's own, or -1.
  FbxTransform local;     // As the file was saved.
  FbxTransform geometry;  // Of the meshes in the node; nodes below do not inherit it.
};

struct FbxSceneMotion {
  std::string name;
  double frame_time = 0;  // Seconds.
  // Of the nodes that it animates; one frame for those that it sets for all of its time.
  std::map<size_t, std::vector<FbxTransform>> frames;
};

struct FbxScene {
  std::vector<FbxSceneNode> nodes;  // Depth first.
  std::vector<FbxSceneMotion> motions;
  Quatd to_y_up;      // From the file's axes.
  double metres = 1;  // Per unit.
  bool has_meshes = false;
};

// Rejects what parse_fbx() does, with the same messages.
Result<FbxScene> read_fbx_scene(std::string bytes, const std::string& name);
// The bytes of a file of version 7 without its motions; other versions stay as they are.
Result<std::string> fbx_without_motions(std::string bytes, const std::string& name);

}  // namespace panache
