#include "fbx_scene.h"

#include <algorithm>
#include <vector>

#include "fbx_takes.h"

namespace panache::cli {
namespace {

// A limit on frames times joints of all takes, so that no small file takes long to read. A file
// with a key in every frame is larger than that.
double most_poses(std::string_view text) {
  return std::max(1e6, 4 * static_cast<double>(text.size()));
}

template <class Vec>
Vec assimp(Vec3d v) {
  return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)};
}

aiQuaternion assimp(Quatd q) {
  return {static_cast<float>(q.w), static_cast<float>(q.x), static_cast<float>(q.y),
          static_cast<float>(q.z)};
}

aiMatrix4x4 matrix(const Trs& trs) {
  return {assimp<aiVector3D>(trs.scale), assimp(trs.rotation), assimp<aiVector3D>(trs.translation)};
}

void add_nodes(const std::vector<FbxModel>& models, aiScene& scene) {
  scene.mRootNode = new aiNode("RootNode");
  std::vector<aiNode*> nodes;
  std::vector<std::vector<aiNode*>> children(models.size() + 1);  // The last one is for the root.
  for (const FbxModel& model : models) {
    nodes.push_back(new aiNode(model.name));
    nodes.back()->mTransformation = matrix(model.trs(model.place));
    const size_t parent = model.parent < 0 ? models.size() : static_cast<size_t>(model.parent);
    children[parent].push_back(nodes.back());
  }
  nodes.push_back(scene.mRootNode);
  for (size_t i = 0; i < nodes.size(); ++i) {
    if (children[i].empty()) continue;
    nodes[i]->addChildren(static_cast<unsigned>(children[i].size()), children[i].data());
  }
}

void add_settings(const FbxSettings& settings, aiScene& scene) {
  scene.mMetaData = new aiMetadata;
  scene.mMetaData->Add("UpAxis", settings.up_axis);
  scene.mMetaData->Add("UpAxisSign", settings.up_sign);
  scene.mMetaData->Add("CoordAxis", settings.side_axis);
  scene.mMetaData->Add("CoordAxisSign", settings.side_sign);
  scene.mMetaData->Add("UnitScaleFactor", static_cast<float>(settings.centimetres));
}

aiNodeAnim* make_channel(const FbxModel& model, const FbxTake& take, const FbxCurves& curves,
                         const std::vector<int64_t>& times) {
  auto* channel = new aiNodeAnim;
  channel->mNodeName = model.name;
  const auto count = static_cast<unsigned>(times.size());
  channel->mNumPositionKeys = channel->mNumRotationKeys = channel->mNumScalingKeys = count;
  channel->mPositionKeys = new aiVectorKey[count];
  channel->mRotationKeys = new aiQuatKey[count];
  channel->mScalingKeys = new aiVectorKey[count];
  for (unsigned i = 0; i < count; ++i) {
    const Trs trs = model.trs(fbx_place(curves, model.place, times[i]));
    const double seconds = static_cast<double>(times[i] - take.begin) / kFbxSecond;
    channel->mPositionKeys[i] = {seconds, assimp<aiVector3D>(trs.translation)};
    channel->mRotationKeys[i] = {seconds, assimp(trs.rotation)};
    channel->mScalingKeys[i] = {seconds, assimp<aiVector3D>(trs.scale)};
  }
  return channel;
}

aiAnimation* make_animation(const std::vector<FbxModel>& models, const FbxTake& take, double rate) {
  auto* animation = new aiAnimation;
  animation->mName = take.name;
  animation->mTicksPerSecond = 1;
  animation->mDuration = static_cast<double>(take.end - take.begin) / kFbxSecond;
  animation->mChannels = new aiNodeAnim*[take.curves.size()];
  for (const auto& [index, curves] : take.curves) {
    animation->mChannels[animation->mNumChannels++] =
        make_channel(models[index], take, curves, fbx_pose_times(take, curves, rate));
  }
  return animation;
}

// Meshes are geometries in FBX 7, and models in FBX 6.
bool has_meshes(const FbxDocument& document) {
  return std::ranges::any_of(document.in_sections("Objects"), [](const FbxNode* node) {
    return !node->values.empty() && node->values.back() == "Mesh";
  });
}

}  // namespace

Result<FbxScene> fbx_text_scene(std::string_view text, const std::string& path) {
  Result<FbxDocument> document = FbxDocument::parse(text, path);
  if (!document) return document.error();
  if (const int version = document->version(); version > 0 && version < 6000) {
    return Error{path + ": expected FBX 6 or 7, found version " + std::to_string(version) +
                 "; Autodesk's FBX Converter makes FBX 7 of it"};
  }
  Result<FbxSettings> settings = fbx_settings(*document);
  if (!settings) return settings.error();
  Result<std::vector<FbxModel>> models = fbx_models(*document);
  if (!models) return models.error();
  if (models->empty()) return FbxScene();
  Result<std::vector<FbxTake>> takes = fbx_takes(*document, *models);
  if (!takes) return takes.error();
  double poses = 0;
  for (const FbxTake& take : *takes) {
    const double frames = static_cast<double>(take.end - take.begin) / kFbxSecond * settings->rate;
    poses += frames * static_cast<double>(take.curves.size());
  }
  if (poses > most_poses(text)) {
    return Error{path + ": expected motions of at most " +
                 std::to_string(static_cast<int64_t>(most_poses(text))) +
                 " frames, times joints, in all, as the file is of this size; found more; is the "
                 "time of a key wrong?"};
  }
  auto scene = std::make_unique<aiScene>();
  scene->mFlags = AI_SCENE_FLAGS_INCOMPLETE;  // It has no meshes.
  add_nodes(*models, *scene);
  add_settings(*settings, *scene);
  if (!takes->empty()) scene->mAnimations = new aiAnimation*[takes->size()];
  for (const FbxTake& take : *takes) {
    scene->mAnimations[scene->mNumAnimations++] = make_animation(*models, take, settings->rate);
  }
  return FbxScene{std::move(scene), has_meshes(*document)};
}

}  // namespace panache::cli
