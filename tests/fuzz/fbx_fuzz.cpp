// FBX: bytes that begin as its text or as its binary form of version 6 are read by our own reader.
// All others say what scene, of any tree, numbers, skins and animations, Assimp has read out of a
// file. Assimp's own reading happens in a process that is locked down, and is not fuzzed.

#include <cmath>
#include <memory>
#include <vector>

#include <fuzzer/FuzzedDataProvider.h>

#include "any_number.h"
#include "fbx_document.h"
#include "fbx_scene.h"
#include "use_motion.h"

namespace {

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

aiVectorKey* any_keys(FuzzedDataProvider& data, unsigned& count) {
  count = data.ConsumeIntegralInRange(0u, 3u);
  auto* keys = new aiVectorKey[count];
  for (unsigned i = 0; i < count; ++i) keys[i] = {i * 1.0, any_vector(data)};
  return keys;
}

aiNodeAnim* any_channel(FuzzedDataProvider& data) {
  auto* channel = new aiNodeAnim;
  channel->mNodeName = any_name(data);
  channel->mPositionKeys = any_keys(data, channel->mNumPositionKeys);
  channel->mScalingKeys = any_keys(data, channel->mNumScalingKeys);
  channel->mNumRotationKeys = data.ConsumeIntegralInRange(0u, 2u);
  channel->mRotationKeys = new aiQuatKey[channel->mNumRotationKeys];
  return channel;
}

aiAnimation* any_animation(FuzzedDataProvider& data) {
  auto* animation = new aiAnimation;
  animation->mNumChannels = data.ConsumeIntegralInRange(0u, 4u);
  animation->mChannels =
      make_all<aiNodeAnim>(animation->mNumChannels, [&] { return any_channel(data); });
  return animation;
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
  scene->mNumAnimations = data.ConsumeIntegralInRange(0u, 2u);
  scene->mAnimations =
      make_all<aiAnimation>(scene->mNumAnimations, [&] { return any_animation(data); });
  scene->mRootNode = any_tree(data, scene->mNumMeshes);
  if (data.ConsumeBool()) {
    scene->mMetaData = new aiMetadata;
    scene->mMetaData->Add("UnitScaleFactor", any_number(data));
    for (const char* name : {"UpAxis", "UpAxisSign", "CoordAxis", "CoordAxisSign"}) {
      scene->mMetaData->Add(name, data.ConsumeIntegral<int>());
    }
  }
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
    const aiVector3D place =
        channel.mNumPositionKeys ? channel.mPositionKeys[k].mValue : aiVector3D();
    if (!std::isfinite(q.w + q.x + q.y + q.z + place.x + place.y + place.z)) {
      panache::fuzz::fail("a key that is no number");
    }
    if (k > 0 && !(channel.mRotationKeys[k].mTime > channel.mRotationKeys[k - 1].mTime)) {
      panache::fuzz::fail("keys out of order");
    }
  }
}

void read_text(std::string_view text) {
  const panache::Result<panache::cli::FbxScene> read = panache::cli::fbx_text_scene(text, "fbx");
  if (!read || !read->scene) return;
  aiScene& scene = *read->scene;
  panache::cli::repair_scene(scene);
  for (unsigned a = 0; a < scene.mNumAnimations; ++a) {
    const aiAnimation& animation = *scene.mAnimations[a];
    for (unsigned c = 0; c < animation.mNumChannels; ++c) check_channel(*animation.mChannels[c]);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  const std::string_view file(reinterpret_cast<const char*>(bytes), size);
  if (const int version = panache::cli::binary_fbx_version(file); version > 0) {
    if (const auto text = panache::cli::fbx_text_of(file, "fbx")) read_text(*text);
    return 0;
  }
  if (file.starts_with("; FBX")) {
    read_text(file);
    return 0;
  }
  FuzzedDataProvider data(bytes, size);
  const std::unique_ptr<aiScene> scene = any_scene(data);
  panache::cli::repair_scene(*scene);
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) check_weights(*scene->mMeshes[m]);
  return 0;
}
