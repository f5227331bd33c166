#include "fbx_scene.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <vector>

namespace panache::cli {
namespace {

// An axis of the file as the global settings have it: 0 x, 1 y, 2 z and a sign.
aiVector3D axis_of(const aiScene& scene, const std::string& name, int fallback) {
  int axis = fallback, sign = 1;
  scene.mMetaData->Get(name, axis);
  scene.mMetaData->Get(name + "Sign", sign);
  aiVector3D out;
  out[static_cast<unsigned>(std::clamp(axis, 0, 2))] = sign < 0 ? -1.0f : 1.0f;
  return out;
}

// Turns the file's axes to x to the side, y up, and scales to metres.
aiMatrix4x4 to_metres_y_up(const aiScene& scene) {
  if (!scene.mMetaData) return {};
  float centimetres = 1;
  scene.mMetaData->Get("UnitScaleFactor", centimetres);
  if (!(centimetres > 1e-9f && centimetres < 1e9f)) centimetres = 1;
  const aiVector3D up = axis_of(scene, "UpAxis", 1);
  aiVector3D side = axis_of(scene, "CoordAxis", 0);
  if (std::abs(side * up) > 0) side = {up.y, up.z, up.x};  // Settings that contradict themselves.
  const aiVector3D front = side ^ up;
  const float s = centimetres * 0.01f;
  return {side.x * s,  side.y * s,  side.z * s,  0, up.x * s, up.y * s, up.z * s, 0,
          front.x * s, front.y * s, front.z * s, 0, 0,        0,        0,        1};
}

// Parents before children.
std::vector<aiNode*> all_nodes(const aiScene& scene) {
  std::vector<aiNode*> nodes = {scene.mRootNode};
  for (size_t i = 0; i < nodes.size(); ++i) {
    nodes.insert(nodes.end(), nodes[i]->mChildren, nodes[i]->mChildren + nodes[i]->mNumChildren);
  }
  return nodes;
}

// Assimp gives every animated node keys for all of translation, rotation and scale. Translations
// and scales that only repeat the node's own say nothing, but a joint that has them looks as if it
// moved.
void drop_idle_keys(aiNodeAnim& channel, const aiNode& node) {
  aiVector3D scale, place;
  aiQuaternion turn;
  node.mTransformation.Decompose(scale, turn, place);
  // Programs that sample a motion while they write it round in the world, far from the origin. Two
  // hundredths of a millimetre on a limb are no motion.
  const float near = 1e-4f * place.Length();
  const auto idle = [](const aiVectorKey* keys, unsigned count, const aiVector3D& value,
                       float tolerance) {
    return std::all_of(keys, keys + count, [&](const aiVectorKey& key) {
      return (key.mValue - value).Length() <= tolerance;
    });
  };
  if (idle(channel.mPositionKeys, channel.mNumPositionKeys, place, near)) {
    channel.mNumPositionKeys = 0;
  }
  if (idle(channel.mScalingKeys, channel.mNumScalingKeys, scale, 1e-4f * scale.Length())) {
    channel.mNumScalingKeys = 0;
  }
}

// Whether all animations have keys for the node, so that its own place counts for none of them.
bool is_always_animated(const aiScene& scene, const aiNode& node) {
  const auto has_keys = [&](const aiAnimation* animation) {
    return std::any_of(animation->mChannels, animation->mChannels + animation->mNumChannels,
                       [&](const aiNodeAnim* channel) {
                         return channel->mNodeName == node.mName && channel->mNumPositionKeys &&
                                channel->mNumRotationKeys && channel->mNumScalingKeys;
                       });
  };
  return scene.mNumAnimations > 0 &&
         std::all_of(scene.mAnimations, scene.mAnimations + scene.mNumAnimations, has_keys);
}

bool is_usable(const aiMatrix4x4& m) { return std::isnormal(m.Determinant()); }

using Places = std::map<std::string, aiMatrix4x4>;  // World, by the node's name.

// Where skinned joints are when their meshes are not bent. Assimp measures from the mesh's node.
Places bind_places(const aiScene& scene, const Places& world) {
  Places out;
  const auto add = [&](const aiMesh& mesh, const aiMatrix4x4& place) {
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
      const aiBone& bone = *mesh.mBones[i];
      if (!is_usable(bone.mOffsetMatrix)) continue;
      out.emplace(bone.mName.C_Str(), place * aiMatrix4x4(bone.mOffsetMatrix).Inverse());
    }
  };
  for (const aiNode* node : all_nodes(scene)) {
    for (unsigned i = 0; i < node->mNumMeshes; ++i) {
      add(*scene.mMeshes[node->mMeshes[i]], world.at(node->mName.C_Str()));
    }
  }
  return out;
}

Places world_places(const aiScene& scene) {
  Places out;
  for (const aiNode* node : all_nodes(scene)) {  // Parents first.
    const aiMatrix4x4 above = node->mParent ? out[node->mParent->mName.C_Str()] : aiMatrix4x4();
    out[node->mName.C_Str()] = above * node->mTransformation;
  }
  return out;
}

// An FBX file's nodes stand as they stood when it was written, most often as in the first frame of
// the motion, while the rest pose that others want to know is that of the skin.
void rest_as_bound(const aiScene& scene) {
  const Places bound = bind_places(scene, world_places(scene));
  Places world;
  for (aiNode* node : all_nodes(scene)) {
    const aiMatrix4x4 above = node->mParent ? world[node->mParent->mName.C_Str()] : aiMatrix4x4();
    const auto place = bound.find(node->mName.C_Str());
    if (place != bound.end() && is_usable(above) && is_always_animated(scene, *node)) {
      node->mTransformation = aiMatrix4x4(above).Inverse() * place->second;
    }
    world[node->mName.C_Str()] = above * node->mTransformation;
  }
}

// Moves the points of a mesh by `by`, its bones' offsets the other way.
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
  for (unsigned i = 0; i < mesh.mNumBones; ++i) mesh.mBones[i]->mOffsetMatrix *= back;
}

void share_bind_pose(aiScene& scene) {
  std::map<std::string, aiMatrix4x4> offsets;  // Of the first mesh that has the bone.
  for (unsigned m = 0; m < scene.mNumMeshes; ++m) {
    aiMesh& mesh = *scene.mMeshes[m];
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
      const auto known = offsets.find(mesh.mBones[i]->mName.C_Str());
      if (known == offsets.end() || !is_usable(known->second)) continue;
      const aiMatrix4x4 by = aiMatrix4x4(known->second).Inverse() * mesh.mBones[i]->mOffsetMatrix;
      if (is_usable(by) && !by.Equal(aiMatrix4x4(), 1e-6f)) move_mesh(mesh, by);
      break;
    }
    for (unsigned i = 0; i < mesh.mNumBones; ++i) {
      offsets.emplace(mesh.mBones[i]->mName.C_Str(), mesh.mBones[i]->mOffsetMatrix);
    }
  }
}

}  // namespace

void repair_scene(aiScene& scene) {
  rest_as_bound(scene);
  std::map<std::string, const aiNode*> nodes;
  for (const aiNode* node : all_nodes(scene)) nodes.emplace(node->mName.C_Str(), node);
  for (unsigned a = 0; a < scene.mNumAnimations; ++a) {
    aiAnimation& animation = *scene.mAnimations[a];
    for (unsigned c = 0; c < animation.mNumChannels; ++c) {
      const auto node = nodes.find(animation.mChannels[c]->mNodeName.C_Str());
      if (node != nodes.end()) drop_idle_keys(*animation.mChannels[c], *node->second);
    }
  }
  share_bind_pose(scene);
  scene.mRootNode->mTransformation = to_metres_y_up(scene) * scene.mRootNode->mTransformation;
}

}  // namespace panache::cli
