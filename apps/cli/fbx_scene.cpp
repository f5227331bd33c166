#include "fbx_scene.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace panache::cli {
namespace {

// Rotates the file's axes to x sideways and y up, and scales to metres.
aiMatrix4x4 to_metres_y_up(const FbxScene& fbx) {
  const auto s = static_cast<float>(fbx.metres);
  const auto q = fbx.to_y_up.as<float>();
  return {aiVector3D(s, s, s), aiQuaternion(q.w, q.x, q.y, q.z), aiVector3D()};
}

std::span<aiAnimation* const> animations_of(const aiScene& scene) {
  return {scene.mAnimations, scene.mNumAnimations};
}
std::span<aiNodeAnim* const> channels_of(const aiAnimation& animation) {
  return {animation.mChannels, animation.mNumChannels};
}
std::span<aiMesh* const> meshes_of(const aiScene& scene) {
  return {scene.mMeshes, scene.mNumMeshes};
}
std::span<aiBone* const> bones_of(const aiMesh& mesh) { return {mesh.mBones, mesh.mNumBones}; }

// Assimp gives every animated node translation, rotation and scale keys. Translations and scales
// that only repeat the node's own are redundant, but make the joint look as if it moved.
void drop_idle_keys(aiNodeAnim& channel, const aiNode& node) {
  aiVector3D scale, position;
  aiQuaternion turn;
  node.mTransformation.Decompose(scale, turn, position);
  // Programs that bake a motion round its world positions, far from the origin. 0.02 mm on a limb
  // is not motion.
  const float near = 1e-4f * position.Length();
  const auto idle = [](const aiVectorKey* keys, unsigned count, const aiVector3D& value,
                       float tolerance) {
    return std::all_of(keys, keys + count, [&](const aiVectorKey& key) {
      return (key.mValue - value).Length() <= tolerance;
    });
  };
  if (idle(channel.mPositionKeys, channel.mNumPositionKeys, position, near)) {
    channel.mNumPositionKeys = 0;
  }
  if (idle(channel.mScalingKeys, channel.mNumScalingKeys, scale, 1e-4f * scale.Length())) {
    channel.mNumScalingKeys = 0;
  }
}

// Whether all animations have keys for the node, so that its static transform is never used.
bool is_always_animated(const aiScene& scene, const aiNode& node) {
  const auto has_keys = [&](const aiAnimation* animation) {
    return std::ranges::any_of(channels_of(*animation), [&](const aiNodeAnim* channel) {
      return channel->mNodeName == node.mName && channel->mNumPositionKeys &&
             channel->mNumRotationKeys && channel->mNumScalingKeys;
    });
  };
  return scene.mNumAnimations > 0 && std::ranges::all_of(animations_of(scene), has_keys);
}

using Transforms = std::map<std::string, aiMatrix4x4>;  // World transforms, by node name.

// The world transforms of skinned joints in the bind pose. Assimp stores them relative to the
// mesh's node.
Transforms bind_transforms(const aiScene& scene, const Transforms& world) {
  Transforms out;
  const auto add = [&](const aiMesh& mesh, const aiMatrix4x4& transform) {
    for (const aiBone* bone : bones_of(mesh)) {
      if (!is_usable(bone->mOffsetMatrix)) continue;
      out.emplace(bone->mName.C_Str(), transform * aiMatrix4x4(bone->mOffsetMatrix).Inverse());
    }
  };
  for (const aiNode* node : all_nodes(scene)) {
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      add(*scene.mMeshes[node->mMeshes[i]], world.at(node->mName.C_Str()));
    }
  }
  return out;
}

Transforms world_transforms(const aiScene& scene) {
  Transforms out;
  for (const aiNode* node : all_nodes(scene)) {  // Parents before children.
    const aiMatrix4x4 above = node->mParent ? out[node->mParent->mName.C_Str()] : aiMatrix4x4();
    out[node->mName.C_Str()] = above * node->mTransformation;
  }
  return out;
}

// Nodes of an FBX file have their pose at the time of saving, usually the first frame of the
// motion, but the rest pose should be the skin's bind pose.
void rest_as_bound(const aiScene& scene) {
  const Transforms bound = bind_transforms(scene, world_transforms(scene));
  Transforms world;
  for (aiNode* node : all_nodes(scene)) {
    const aiMatrix4x4 above = node->mParent ? world[node->mParent->mName.C_Str()] : aiMatrix4x4();
    const auto found = bound.find(node->mName.C_Str());
    if (found != bound.end() && is_usable(above) && is_always_animated(scene, *node)) {
      node->mTransformation = aiMatrix4x4(above).Inverse() * found->second;
    }
    world[node->mName.C_Str()] = above * node->mTransformation;
  }
}

void share_bind_pose(aiScene& scene) {
  std::map<std::string, aiMatrix4x4> offsets;  // From the first mesh that has the bone.
  for (aiMesh* mesh : meshes_of(scene)) {
    for (const aiBone* bone : bones_of(*mesh)) {
      const auto known = offsets.find(bone->mName.C_Str());
      if (known == offsets.end() || !is_usable(known->second)) continue;
      const aiMatrix4x4 by = aiMatrix4x4(known->second).Inverse() * bone->mOffsetMatrix;
      if (is_usable(by) && !by.Equal(aiMatrix4x4(), 1e-6f)) move_mesh(*mesh, by);
      break;
    }
    for (const aiBone* bone : bones_of(*mesh)) {
      offsets.emplace(bone->mName.C_Str(), bone->mOffsetMatrix);
    }
  }
}

// glTF expects weights that sum to one, in sets of four. Keeps the four heaviest of each vertex; a
// vertex without any follows the mesh's first joint.
void fit_weights(aiMesh& mesh) {
  constexpr size_t kMaxJoints = 4;
  if (mesh.mNumBones == 0) return;
  std::vector<std::vector<std::pair<float, unsigned>>> corners(mesh.mNumVertices);
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone& bone = *mesh.mBones[b];
    for (unsigned i = 0; i < bone.mNumWeights; ++i) {
      const aiVertexWeight& weight = bone.mWeights[i];
      if (weight.mVertexId >= corners.size() || !(weight.mWeight > 0)) continue;
      if (!std::isfinite(weight.mWeight)) continue;
      corners[weight.mVertexId].emplace_back(weight.mWeight, b);
    }
  }
  std::vector<std::vector<aiVertexWeight>> weights(mesh.mNumBones);
  for (unsigned v = 0; v < corners.size(); ++v) {
    auto& corner = corners[v];
    if (corner.empty()) corner.emplace_back(1.0f, 0u);
    std::stable_sort(corner.begin(), corner.end(),
                     [](const auto& a, const auto& b) { return a.first > b.first; });
    corner.resize(std::min(corner.size(), kMaxJoints));
    double sum = 0;  // Double, because the floats may be huge.
    for (const auto& [weight, bone] : corner) sum += weight;
    for (const auto& [weight, bone] : corner) {
      weights[bone].emplace_back(v, static_cast<float>(weight / sum));
    }
  }
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    aiBone& bone = *mesh.mBones[b];
    delete[] bone.mWeights;
    bone.mNumWeights = static_cast<unsigned>(weights[b].size());
    bone.mWeights = new aiVertexWeight[weights[b].size()];
    std::copy(weights[b].begin(), weights[b].end(), bone.mWeights);
  }
}

// Programs often use centimetres below a node that scales to metres, and some scale up again. If no
// scale is animated or non-uniform, node scales are baked into the transforms below them. Only a
// mesh without a skin keeps its scale, in its own node.
void remove_scales(const aiScene& scene) {
  for (const aiAnimation* animation : animations_of(scene)) {
    for (const aiNodeAnim* channel : channels_of(*animation)) {
      if (channel->mNumScalingKeys > 0) return;
    }
  }
  const std::vector<aiNode*> nodes = all_nodes(scene);
  aiVector3D scale, position;
  aiQuaternion turn;
  for (const aiNode* node : nodes) {
    node->mTransformation.Decompose(scale, turn, position);
    const bool even = std::abs(scale.y - scale.x) <= 1e-4f * scale.x &&
                      std::abs(scale.z - scale.x) <= 1e-4f * scale.x;
    if (!even || !std::isnormal(scale.x)) return;
  }
  std::map<std::string, float> above, removed;  // Scale factors, by node name.
  for (aiNode* node : nodes) {
    const std::string name = node->mName.C_Str();
    above[name] = node->mParent ? removed[node->mParent->mName.C_Str()] : 1.0f;
    node->mTransformation.Decompose(scale, turn, position);
    const float all = above[name] * scale.x;
    const bool keeps =
        std::any_of(node->mMeshes, node->mMeshes + node->mNumMeshes,
                    [&](unsigned mesh) { return scene.mMeshes[mesh]->mNumBones == 0; });
    const float own = keeps ? all : 1.0f;
    node->mTransformation = aiMatrix4x4({own, own, own}, turn, position * above[name]);
    removed[name] = all / own;
  }
  for (const aiMesh* mesh : meshes_of(scene)) {
    for (aiBone* bone : bones_of(*mesh)) {
      const auto lost = removed.find(bone->mName.C_Str());
      if (lost == removed.end()) continue;
      aiMatrix4x4 grow;
      aiMatrix4x4::Scaling({lost->second, lost->second, lost->second}, grow);
      bone->mOffsetMatrix = grow * bone->mOffsetMatrix;
    }
  }
  for (const aiAnimation* animation : animations_of(scene)) {
    for (aiNodeAnim* channel : channels_of(*animation)) {
      const auto lost = above.find(channel->mNodeName.C_Str());
      if (lost == above.end()) continue;
      for (unsigned k = 0; k < channel->mNumPositionKeys; ++k) {
        channel->mPositionKeys[k].mValue *= lost->second;
      }
    }
  }
}

}  // namespace

std::vector<aiNode*> all_nodes(const aiScene& scene) {
  std::vector<aiNode*> nodes = {scene.mRootNode};
  for (size_t i = 0; i < nodes.size(); ++i) {
    nodes.insert(nodes.end(), nodes[i]->mChildren, nodes[i]->mChildren + nodes[i]->mNumChildren);
  }
  return nodes;
}

void move_mesh(aiMesh& mesh, const aiMatrix4x4& by) {
  const aiMatrix3x3 turn = aiMatrix3x3(aiMatrix4x4(by).Inverse().Transpose());
  const auto move = [&](aiVector3D* points, aiVector3D* normals, unsigned count) {
    for (unsigned i = 0; i < count; ++i) {
      if (points) points[i] = by * points[i];
      if (normals) normals[i] = (turn * normals[i]).NormalizeSafe();
    }
  };
  move(mesh.mVertices, mesh.mNormals, mesh.mNumVertices);
  for (unsigned i = 0; i < mesh.mNumAnimMeshes; ++i) {
    move(mesh.mAnimMeshes[i]->mVertices, mesh.mAnimMeshes[i]->mNormals,
         mesh.mAnimMeshes[i]->mNumVertices);
  }
  const aiMatrix4x4 back = aiMatrix4x4(by).Inverse();
  for (aiBone* bone : bones_of(mesh)) bone->mOffsetMatrix *= back;
}

void repair_scene(const FbxScene& fbx, aiScene& scene) {
  rest_as_bound(scene);
  std::map<std::string, const aiNode*> nodes;
  for (const aiNode* node : all_nodes(scene)) nodes.emplace(node->mName.C_Str(), node);
  for (const aiAnimation* animation : animations_of(scene)) {
    for (aiNodeAnim* channel : channels_of(*animation)) {
      const auto node = nodes.find(channel->mNodeName.C_Str());
      if (node != nodes.end()) drop_idle_keys(*channel, *node->second);
    }
  }
  share_bind_pose(scene);
  scene.mRootNode->mTransformation = to_metres_y_up(fbx) * scene.mRootNode->mTransformation;
  remove_scales(scene);
  for (aiMesh* mesh : meshes_of(scene)) fit_weights(*mesh);
}

}  // namespace panache::cli
