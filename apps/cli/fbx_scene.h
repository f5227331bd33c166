#pragma once
// Scenes of FBX files: meshes as Assimp reads them, nodes and motions as our own reader does.

#include <cmath>
#include <memory>
#include <vector>

#include <assimp/scene.h>

#include "clip/fbx_nodes.h"

namespace panache::cli {

// fbx_nodes.cpp: a scene of the nodes and motions alone.
std::unique_ptr<aiScene> make_scene(const FbxScene& fbx);
// Gives a scene with meshes and no animations the nodes' names, transforms and motions. A mesh
// stays where it is in the world, as does what it is bound to.
void set_nodes(const FbxScene& fbx, aiScene& scene);

// Prepares a scene for glTF: puts the file's unit and axes on the root (metres, +Y up); sets the
// rest pose of skinned joints to the bind pose; removes redundant animation keys; gives all meshes
// one bind pose, as Assimp writes them with one skin; bakes node scales into the transforms below;
// and limits each vertex to four joints, with weights that sum to one.
void repair_scene(const FbxScene& fbx, aiScene& scene);

// All nodes, parents before children.
std::vector<aiNode*> all_nodes(const aiScene& scene);
// Whether a matrix can be inverted.
inline bool is_usable(const aiMatrix4x4& m) { return std::isnormal(m.Determinant()); }
// Transforms the vertices of a mesh by `by`, and its bones' offsets by the inverse.
void move_mesh(aiMesh& mesh, const aiMatrix4x4& by);

}  // namespace panache::cli
