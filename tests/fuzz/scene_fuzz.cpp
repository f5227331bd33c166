// What scene, of any tree, numbers and skins, Assimp has read out of an FBX file, and what nodes
// and motions our own reader has. Assimp's own reading happens in a process that is locked down,
// and is not fuzzed.

#include <cmath>
#include <memory>
#include <vector>

#include <fuzzer/FuzzedDataProvider.h>

#include "any_number.h"
#include "fbx_scene.h"
#include "use_motion.h"

namespace {

using panache::Vec3d;
using panache::fuzz::any_number;

// Few, so that nodes, bones and channels often mean each other, or several of one name.
std::string any_name(FuzzedDataProvider& data) {
  constexpr const char* kNames[] = {"a", "b", "c", "d", ""};
  return data.PickValueInArray(kNames);
}

aiVector3D any_vector(FuzzedDataProvider& data) {
  return {any_number(data), any_number(data), any_number(data)};
}

aiMatrix4x4 any_matrix(FuzzedDataProvider& data) {
  aiMatrix4x4 out;
  for (int changes = data.ConsumeIntegralInRange(0, 6); changes > 0; --changes) {
    out[data.ConsumeIntegralInRange(0u, 3u)][data.ConsumeIntegralInRange(0u, 3u)] =
        any_number(data);
  }
  return out;
}

// `count` things, in an array as Assimp has it: it gives none back that is empty.
template <class T, class Make>
T** make_all(unsigned count, Make make) {
  if (count == 0) return nullptr;
  T** out = new T*[count];
  for (unsigned i = 0; i < count; ++i) out[i] = make();
  return out;
}

aiBone* any_bone(FuzzedDataProvider& data) {
  auto* bone = new aiBone;
  bone->mName = any_name(data);
  bone->mOffsetMatrix = any_matrix(data);
  bone->mNumWeights = data.ConsumeIntegralInRange(0u, 6u);
  bone->mWeights = new aiVertexWeight[bone->mNumWeights];
  for (unsigned i = 0; i < bone->mNumWeights; ++i) {
    bone->mWeights[i] = {data.ConsumeIntegralInRange(0u, 5u), any_number(data)};
  }
  return bone;
}

aiMesh* any_mesh(FuzzedDataProvider& data) {
  auto* mesh = new aiMesh;
  mesh->mNumVertices = data.ConsumeIntegralInRange(0u, 5u);
  mesh->mVertices = new aiVector3D[mesh->mNumVertices];
  for (unsigned i = 0; i < mesh->mNumVertices; ++i) mesh->mVertices[i] = any_vector(data);
  if (data.ConsumeBool()) mesh->mNormals = new aiVector3D[mesh->mNumVertices];
  mesh->mNumBones = data.ConsumeIntegralInRange(0u, 5u);
  mesh->mBones = make_all<aiBone>(mesh->mNumBones, [&] { return any_bone(data); });
  return mesh;
}

// The nodes, each below one that was there before; some have meshes.
aiNode* any_tree(FuzzedDataProvider& data, unsigned meshes) {
  std::vector<aiNode*> nodes;
  for (int count = data.ConsumeIntegralInRange(1, 8); count > 0; --count) {
    auto* node = new aiNode(any_name(data));
    node->mTransformation = any_matrix(data);
    if (meshes > 0 && data.ConsumeBool()) {
      node->mNumMeshes = 1;
      node->mMeshes = new unsigned[1]{data.ConsumeIntegralInRange(0u, meshes - 1)};
    }
    if (!nodes.empty()) {
      nodes[data.ConsumeIntegralInRange<size_t>(0, nodes.size() - 1)]->addChildren(1, &node);
    }
    nodes.push_back(node);
  }
  return nodes.front();
}

std::unique_ptr<aiScene> any_scene(FuzzedDataProvider& data) {
  auto scene = std::make_unique<aiScene>();
  scene->mNumMeshes = data.ConsumeIntegralInRange(0u, 3u);
  scene->mMeshes = make_all<aiMesh>(scene->mNumMeshes, [&] { return any_mesh(data); });
  scene->mRootNode = any_tree(data, scene->mNumMeshes);
  return scene;
}

// That the weights of each corner of a skin sum to one, and those of none to something else.
void check_weights(const aiMesh& mesh) {
  if (mesh.mNumBones == 0) return;
  std::vector<float> sums(mesh.mNumVertices);
  for (unsigned b = 0; b < mesh.mNumBones; ++b) {
    const aiBone& bone = *mesh.mBones[b];
    for (unsigned i = 0; i < bone.mNumWeights; ++i) {
      sums.at(bone.mWeights[i].mVertexId) += bone.mWeights[i].mWeight;
    }
  }
  for (const float sum : sums) {
    if (!(std::abs(sum - 1) < 1e-5f)) panache::fuzz::fail("weights that do not sum to one");
  }
}

// That the keys of each channel have times that grow, and numbers.
void check_channel(const aiNodeAnim& channel) {
  for (unsigned k = 0; k < channel.mNumRotationKeys; ++k) {
    const aiQuaternion& q = channel.mRotationKeys[k].mValue;
    const aiVector3D position =
        channel.mNumPositionKeys ? channel.mPositionKeys[k].mValue : aiVector3D();
    if (!std::isfinite(q.w + q.x + q.y + q.z + position.x + position.y + position.z)) {
      panache::fuzz::fail("a key that is no number");
    }
    if (k > 0 && !(channel.mRotationKeys[k].mTime > channel.mRotationKeys[k - 1].mTime)) {
      panache::fuzz::fail("keys out of order");
    }
  }
}

// Our reader lets only numbers within bounds pass.
Vec3d any_vec(FuzzedDataProvider& data, double max) {
  const auto one = [&] { return data.ConsumeFloatingPointInRange(-max, max); };
  const double x = one(), y = one(), z = one();
  return {x, y, z};
}

panache::FbxTransform any_transform(FuzzedDataProvider& data) {
  panache::FbxTransform out;
  if (data.ConsumeBool()) out.translation = any_vec(data, 1e6);
  if (data.ConsumeBool()) out.rotation = exp_rotation(any_vec(data, 10));
  if (data.ConsumeBool()) out.scale = any_vec(data, 100);
  return out;
}

panache::FbxScene any_fbx(FuzzedDataProvider& data) {
  panache::FbxScene out;
  out.metres = data.ConsumeFloatingPointInRange(1e-8, 1e4);
  const int count = data.ConsumeIntegralInRange(0, 6);
  for (int n = 0; n < count; ++n) {
    const std::string name = any_name(data);
    // Unique, as our reader makes them.
    out.nodes.push_back({name + std::to_string(n), name, data.ConsumeIntegralInRange(-1, n - 1),
                         any_transform(data), any_transform(data)});
  }
  for (int m = data.ConsumeIntegralInRange(0, 2); m > 0; --m) {
    panache::FbxSceneMotion& motion = out.motions.emplace_back();
    motion.frame_time = 0.1;
    for (size_t n = 0; n < out.nodes.size(); ++n) {
      for (int f = data.ConsumeIntegralInRange(0, 2); f > 0; --f) {
        motion.frames[n].push_back(any_transform(data));
      }
    }
  }
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  FuzzedDataProvider data(bytes, size);
  const std::unique_ptr<aiScene> scene = any_scene(data);
  const panache::FbxScene fbx = any_fbx(data);
  panache::cli::set_nodes(fbx, *scene);
  panache::cli::repair_scene(fbx, *scene);
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) check_weights(*scene->mMeshes[m]);
  const std::unique_ptr<aiScene> bare = panache::cli::make_scene(fbx);
  panache::cli::repair_scene(fbx, *bare);
  for (const aiScene* of : {scene.get(), bare.get()}) {
    for (unsigned a = 0; a < of->mNumAnimations; ++a) {
      const aiAnimation& animation = *of->mAnimations[a];
      for (unsigned c = 0; c < animation.mNumChannels; ++c) check_channel(*animation.mChannels[c]);
    }
  }
  return 0;
}
