// Another reader of FBX, Assimp's, sees in our files what ours does.

#ifdef PANACHE_ASSIMP

#include <assimp/Importer.hpp>
#include <assimp/config.h>
#include <assimp/scene.h>

#include "cli/program.h"
#include "clip/bvh.h"
#include "clip/fbx.h"
#include "clip/make_fbx.h"

namespace panache::test {
namespace {

aiVector3D value_at(const aiVectorKey* keys, unsigned count, double ticks) {
  unsigned k = 0;
  while (k + 1 < count && keys[k + 1].mTime <= ticks + 1e-3) ++k;
  return keys[k].mValue;
}
aiQuaternion value_at(const aiQuatKey* keys, unsigned count, double ticks) {
  unsigned k = 0;
  while (k + 1 < count && keys[k + 1].mTime <= ticks + 1e-3) ++k;
  return keys[k].mValue;
}

void add_positions(const aiNode& node, const aiAnimation& animation, double ticks,
                   const aiMatrix4x4& above, std::map<std::string, aiVector3D>& out) {
  aiMatrix4x4 local = node.mTransformation;
  for (unsigned c = 0; c < animation.mNumChannels; ++c) {
    const aiNodeAnim& channel = *animation.mChannels[c];
    if (channel.mNodeName != node.mName) continue;
    local = aiMatrix4x4(value_at(channel.mScalingKeys, channel.mNumScalingKeys, ticks),
                        value_at(channel.mRotationKeys, channel.mNumRotationKeys, ticks),
                        value_at(channel.mPositionKeys, channel.mNumPositionKeys, ticks));
  }
  const aiMatrix4x4 world = above * local;
  out[node.mName.C_Str()] = {world.a4, world.b4, world.c4};
  for (unsigned i = 0; i < node.mNumChildren; ++i) {
    add_positions(*node.mChildren[i], animation, ticks, world, out);
  }
}

// Within a millimetre, in every frame of the first motion.
void expect_seen_by_assimp(const std::string& bytes, float metres) {
  const auto file = parse_fbx(bytes, "ours.fbx");
  ASSERT_TRUE(file.ok()) << file.error().message;
  Assimp::Importer importer;
  importer.SetPropertyBool(AI_CONFIG_IMPORT_FBX_PRESERVE_PIVOTS, false);
  const aiScene* scene = importer.ReadFileFromMemory(bytes.data(), bytes.size(), 0, "fbx");
  ASSERT_TRUE(scene) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumAnimations, (*file)->clip_names().size());
  const aiAnimation* animation = nullptr;
  for (unsigned a = 0; a < scene->mNumAnimations; ++a) {
    if ((*file)->clip_names()[0] == scene->mAnimations[a]->mName.C_Str()) {
      animation = scene->mAnimations[a];
    }
  }
  ASSERT_TRUE(animation);
  const Clip& clip = (*file)->clip();
  std::vector<Quat> rotations(clip.joints());
  std::vector<Vec3> positions(clip.joints());
  for (int f = 0; f < clip.frames; ++f) {
    std::map<std::string, aiVector3D> seen;
    add_positions(*scene->mRootNode, *animation, f * clip.frame_time * animation->mTicksPerSecond,
                  {}, seen);
    world_pose(clip.skeleton, clip.pose(f), {rotations, positions});
    for (size_t j = 0; j < clip.joints(); ++j) {
      ASSERT_TRUE(seen.contains(clip.skeleton.joints[j].name));
      const aiVector3D at = seen[clip.skeleton.joints[j].name] * metres;
      ASSERT_LE(length(positions[j] - Vec3{at.x, at.y, at.z}), 1e-3f)
          << clip.skeleton.joints[j].name << " in frame " << f;
    }
  }
}

class FbxInAssimp : public ProgramTest {};

TEST_F(FbxInAssimp, a_new_file_is_seen_as_it_was_meant) {
  write("walk.bvh", format_bvh(walking_clip(40)));
  must("stylize walk.bvh --style old=1 -o old.fbx");
  expect_seen_by_assimp(read("old.fbx"), 0.01f);
}

TEST_F(FbxInAssimp, a_styled_file_is_seen_as_it_was_meant) {
  FbxOptions options;
  options.pre_rotation = normalized(Quat{0.3f, -0.5f, 0.2f, 0.7f});
  write("walk.fbx", format_fbx(walking_clip(40), options));
  for (const char* mode : {"--replace", "--first", "--last"}) {
    must({"stylize", "walk.fbx", "--style", "old=1", mode, "--force", "-o", "old.fbx"});
    expect_seen_by_assimp(read("old.fbx"), 0.01f);
  }
}

}  // namespace
}  // namespace panache::test

#endif
