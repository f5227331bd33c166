#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "fbx_scene.h"

namespace panache::cli {
namespace {

template <class Vec>
Vec assimp(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

aiQuaternion assimp(Quatd q) {
  return {static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y),
          static_cast<float>(q.z)};
}

// Not Assimp's constructor from the three, which scales rows: after the rotation, not before it.
aiMatrix4x4 matrix(const FbxTransform& t) {
  const Vec3d x = rotate(t.rotation, Vec3d{t.scale.x, 0, 0}),
              y = rotate(t.rotation, Vec3d{0, t.scale.y, 0}),
              z = rotate(t.rotation, Vec3d{0, 0, t.scale.z}), at = t.translation;
  const auto row = [](double a, double b, double c, double d) {
    return std::array<float, 4>{static_cast<float>(a), static_cast<float>(b), static_cast<float>(c),
                                static_cast<float>(d)};
  };
  const auto [a1, a2, a3, a4] = row(x.x, y.x, z.x, at.x);
  const auto [b1, b2, b3, b4] = row(x.y, y.y, z.y, at.y);
  const auto [c1, c2, c3, c4] = row(x.z, y.z, z.z, at.z);
  return {a1, a2, a3, a4, b1, b2, b3, b4, c1, c2, c3, c4, 0, 0, 0, 1};
}

aiMatrix4x4 world_of(const aiNode* node) {
  aiMatrix4x4 out = node->mTransformation;
  while ((node = node->mParent)) out = node->mTransformation * out;
  return out;
}

aiNodeAnim* make_channel(const std::string& node, const std::vector<FbxTransform>& frames,
                         double frame_time) {
  auto* channel = new aiNodeAnim;
  channel->mNodeName = node;
  const auto count = static_cast<unsigned>(frames.size());
  channel->mNumPositionKeys = channel->mNumRotationKeys = channel->mNumScalingKeys = count;
  channel->mPositionKeys = new aiVectorKey[count];
  channel->mRotationKeys = new aiQuatKey[count];
  channel->mScalingKeys = new aiVectorKey[count];
  for (unsigned i = 0; i < count; ++i) {
    const double seconds = i * frame_time;
    channel->mPositionKeys[i] = {seconds, assimp<aiVector3D>(frames[i].translation)};
    channel->mRotationKeys[i] = {seconds, assimp(frames[i].rotation)};
    channel->mScalingKeys[i] = {seconds, assimp<aiVector3D>(frames[i].scale)};
  }
  return channel;
}

// `names`: [nodes] of the scene; empty for a node that it lacks.
void add_motions(const FbxScene& fbx, const std::vector<std::string>& names, aiScene& scene) {
  if (fbx.motions.empty()) return;
  scene.mAnimations = new aiAnimation*[fbx.motions.size()];
  for (const FbxSceneMotion& motion : fbx.motions) {
    auto* animation = new aiAnimation;
    scene.mAnimations[scene.mNumAnimations++] = animation;
    animation->mName = motion.name;
    animation->mTicksPerSecond = 1;
    std::vector<aiNodeAnim*> channels;
    for (const auto& [node, frames] : motion.frames) {
      if (names[node].empty() || frames.empty()) continue;
      const double duration = static_cast<double>(frames.size() - 1) * motion.frame_time;
      animation->mDuration = std::max(animation->mDuration, duration);
      channels.push_back(make_channel(names[node], frames, motion.frame_time));
    }
    if (channels.empty()) continue;  // Assimp frees no array without channels.
    animation->mNumChannels = static_cast<unsigned>(channels.size());
    animation->mChannels = new aiNodeAnim*[channels.size()];
    std::copy(channels.begin(), channels.end(), animation->mChannels);
  }
}

// Whether Assimp may have called a node so: names that several nodes have get digits.
bool is_name_of(const std::string& assimp, const std::string& file) {
  return assimp.starts_with(file) &&
         std::all_of(assimp.begin() + static_cast<std::ptrdiff_t>(file.size()), assimp.end(),
                     [](char c) { return c >= '0' && c <= '9'; });
}

// Finds the scene's nodes: below one that is known, the next of the right name. Null for those that
// the scene lacks.
std::vector<aiNode*> find_nodes(const FbxScene& fbx, const aiScene& scene) {
  std::vector<aiNode*> out(fbx.nodes.size());
  std::set<const aiNode*> taken;
  for (size_t n = 0; n < fbx.nodes.size(); ++n) {
    const FbxSceneNode& node = fbx.nodes[n];
    aiNode* parent = node.parent < 0 ? scene.mRootNode : out[static_cast<size_t>(node.parent)];
    const auto find = [&](auto fits) {
      for (unsigned c = 0; parent && !out[n] && c < parent->mNumChildren; ++c) {
        aiNode* child = parent->mChildren[c];
        if (taken.contains(child) || !fits(child->mName.C_Str())) continue;
        out[n] = child;
        taken.insert(child);
      }
    };
    find([&](const std::string& name) { return name == node.file_name; });
    find([&](const std::string& name) { return is_name_of(name, node.file_name); });
  }
  return out;
}

// Nodes and the joints that meshes follow, by their new names.
void rename(const FbxScene& fbx, const std::vector<aiNode*>& nodes, aiScene& scene) {
  std::map<std::string, std::string> names;
  std::set<std::string> taken;
  for (size_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n]) names.emplace(nodes[n]->mName.C_Str(), fbx.nodes[n].name);
    taken.insert(fbx.nodes[n].name);
  }
  for (aiNode* node : all_nodes(scene)) {
    const std::string old = node->mName.C_Str();
    const auto found = names.find(old);
    std::string name = found == names.end() ? old : found->second;
    while (found == names.end() && taken.contains(name)) name += "_";
    if (found == names.end()) names.emplace(old, name);
    node->mName = name;
  }
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    for (unsigned b = 0; b < scene.mMeshes[m]->mNumBones; ++b) {
      aiString& bone = scene.mMeshes[m]->mBones[b]->mName;
      if (const auto name = names.find(bone.C_Str()); name != names.end()) bone = name->second;
    }
  }
}

}  // namespace

std::unique_ptr<aiScene> make_scene(const FbxScene& fbx) {
  auto scene = std::make_unique<aiScene>();
  scene->mFlags = AI_SCENE_FLAGS_INCOMPLETE;  // It has no meshes.
  scene->mRootNode = new aiNode("RootNode");
  std::vector<aiNode*> nodes;
  std::vector<std::string> names;
  std::vector<std::vector<aiNode*>> children(fbx.nodes.size() + 1);  // The last is for the root.
  for (const FbxSceneNode& node : fbx.nodes) {
    names.push_back(node.name);
    nodes.push_back(new aiNode(node.name));
    nodes.back()->mTransformation = matrix(node.local);
    const size_t parent = node.parent < 0 ? fbx.nodes.size() : static_cast<size_t>(node.parent);
    children[parent].push_back(nodes.back());
  }
  nodes.push_back(scene->mRootNode);
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (children[i].empty()) continue;
    nodes[i]->addChildren(static_cast<unsigned>(children[i].size()), children[i].data());
  }
  add_motions(fbx, names, *scene);
  return scene;
}

void set_nodes(const FbxScene& fbx, aiScene& scene) {
  const std::vector<aiNode*> nodes = find_nodes(fbx, scene);
  std::map<const aiNode*, aiMatrix4x4> old;  // In the world, as Assimp has placed them.
  for (const aiNode* node : nodes) {
    if (node && node->mNumMeshes > 0) old[node] = world_of(node);
  }
  std::vector<std::string> names;
  for (size_t n = 0; n < nodes.size(); ++n) {
    names.push_back(nodes[n] ? fbx.nodes[n].name : "");
    if (nodes[n]) nodes[n]->mTransformation = matrix(fbx.nodes[n].local);
  }
  std::set<unsigned> done;
  for (size_t n = 0; n < nodes.size(); ++n) {
    if (!nodes[n] || nodes[n]->mNumMeshes == 0) continue;
    const aiMatrix4x4 geometry = matrix(fbx.nodes[n].geometry);
    const aiMatrix4x4 before = old[nodes[n]], now = world_of(nodes[n]) * geometry;
    for (unsigned i = 0; i < nodes[n]->mNumMeshes; ++i) {
      if (!done.insert(nodes[n]->mMeshes[i]).second) continue;
      aiMesh& mesh = *scene.mMeshes[nodes[n]->mMeshes[i]];
      // Assimp binds a mesh where it has placed its node, with the geometry's own transform in it.
      for (unsigned b = 0; b < mesh.mNumBones && is_usable(before); ++b) {
        mesh.mBones[b]->mOffsetMatrix *= aiMatrix4x4(before).Inverse() * now;
      }
      if (is_usable(geometry)) move_mesh(mesh, geometry);
    }
  }
  rename(fbx, nodes, scene);
  add_motions(fbx, names, scene);
}

}  // namespace panache::cli
