// Nodes of an FBX file, as programs show them that multiply transforms, are where the file has
// them.

#include "clip/fbx_nodes.h"

#include <gtest/gtest.h>

#include "clip/make_fbx_scene.h"

namespace panache::test {
namespace {

Affine matrix_of(const FbxTransform& of) {
  Vec3d scale = of.scale;
  Affine out = affine_move(of.translation);
  for (size_t c = 0; c < 3; ++c) {
    Vec3d column;
    column[c] = scale[c];
    column = rotate(of.rotation, column);
    for (size_t r = 0; r < 3; ++r) out[r][c] = column[r];
  }
  return out;
}

// By the transforms in a frame of the first motion.
std::vector<Affine> shown_worlds(const FbxScene& scene, size_t frame) {
  std::vector<Affine> out;
  for (size_t n = 0; n < scene.nodes.size(); ++n) {
    const FbxSceneNode& node = scene.nodes[n];
    FbxTransform local = node.local;
    if (const auto found = scene.motions[0].frames.find(n);
        found != scene.motions[0].frames.end()) {
      local = found->second[std::min(frame, found->second.size() - 1)];
    }
    const Affine own = matrix_of(local);
    out.push_back(node.parent < 0 ? own : out[static_cast<size_t>(node.parent)] * own);
  }
  return out;
}

const std::vector<SceneModel> kModels = {
    {"root", -1, {{"Lcl Translation", {0, 90, 0}}, {"Lcl Scaling", {2, 2, 2}}}},
    {"grown", 0, {{"Lcl Translation", {5, 10, 2}}, {"Lcl Scaling", {1.5, 0.5, 0.8}}}},
    {"below",
     1,
     {{"Lcl Translation", {3, 12, -4}},
      {"Lcl Rotation", {20, 30, 40}},
      {"PreRotation", {0, 50, 0}},
      {"Lcl Scaling", {1, 1, 1.5}}}},
    {"leaf", 2, {{"Lcl Translation", {4, -2, 7}}, {"Lcl Rotation", {-10, 0, 70}}}},
    {"end", 3, {{"Lcl Translation", {1, 8, 3}}}},
    {"prop", 1, {{"Lcl Translation", {1, 2, 3}}, {"Lcl Rotation", {9, 8, 7}}}, "Mesh"}};

SceneCurve line(double begin, double end) { return {{{0, begin}, {10, end}}}; }

std::vector<SceneTransform> transforms_at(const std::vector<SceneModel>& models, double frame) {
  std::vector<SceneTransform> out;
  for (const SceneModel& model : models) out.push_back(saved_transform(model));
  out[1][1] = {9 * frame, 0, 0};
  out[1][2].y = 0.5 + 0.1 * frame;
  out[2][1].z = 40 - 6 * frame;
  return out;
}

const std::vector<SceneStack> kStacks = {{"Take",
                                          {{"BaseLayer",
                                            {},
                                            {{1, 1, {{line(0, 90), {}, {}}}},
                                             {1, 2, {{{}, line(0.5, 1.5), {}}}},
                                             {2, 1, {{{}, {}, line(40, -20)}}}}}}}};

TEST(FbxNodes, each_is_placed_as_it_inherits_scales) {
  for (const double type : {0.0, 1.0, 2.0}) {
    std::vector<SceneModel> models = kModels;
    for (size_t m = 2; m < models.size(); ++m) models[m].numbers["InheritType"] = {type};
    const Result<FbxScene> scene = read_fbx_scene(make_fbx_scene(models, kStacks), "in.fbx");
    ASSERT_TRUE(scene.ok()) << scene.error().message;
    ASSERT_EQ(scene->nodes.size(), models.size());
    for (size_t f = 0; f <= 10; ++f) {
      const std::vector<SceneTransform> transforms = transforms_at(models, static_cast<double>(f));
      const std::vector<Vec3d> expected = positions_by_formula(models, transforms);
      const std::vector<Affine> shown = shown_worlds(*scene, f);
      for (size_t m = 0; m < models.size(); ++m) {
        const size_t n = static_cast<size_t>(
            std::ranges::find(scene->nodes, models[m].name, &FbxSceneNode::name) -
            scene->nodes.begin());
        const Vec3d at = {shown[n][0][3], shown[n][1][3], shown[n][2][3]};
        // Numbers of about 100, through six products of matrices of doubles.
        EXPECT_LE(length(at - expected[m]), 1e-9)
            << models[m].name << " of type " << type << " in frame " << f;
      }
    }
  }
}

TEST(FbxNodes, scales_that_are_the_same_on_all_axes_give_the_very_transform) {
  std::vector<SceneModel> models = kModels;
  models[1].numbers["Lcl Scaling"] = {1.5, 1.5, 1.5};
  models[2].numbers["InheritType"] = {2};
  models[3].numbers["InheritType"] = {0};
  const std::vector<SceneStack> stacks = {
      {"Take", {{"BaseLayer", {}, {{2, 1, {{{}, {}, line(40, -20)}}}}}}}};
  const Result<FbxScene> scene = read_fbx_scene(make_fbx_scene(models, stacks), "in.fbx");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  std::vector<SceneTransform> transforms;
  for (const SceneModel& model : models) transforms.push_back(saved_transform(model));
  const std::vector<Affine> expected = worlds_by_formula(models, transforms);
  const std::vector<Affine> shown = shown_worlds(*scene, 0);
  for (const size_t m : {0u, 1u, 2u}) {  // As far as no axis differs above.
    ASSERT_EQ(scene->nodes[m].name, models[m].name);
    for (size_t r = 0; r < 3; ++r) {
      for (size_t c = 0; c < 4; ++c) EXPECT_NEAR(shown[m][r][c], expected[m][r][c], 1e-9);
    }
  }
}

TEST(FbxNodes, what_curves_only_set_has_one_frame) {
  const std::vector<SceneStack> stacks = {
      {"Take",
       {{"BaseLayer",
         {},
         {{2, 1, {{{}, {}, line(40, -20)}}}, {5, 1, {{line(45, 45), line(0, 0), line(0, 0)}}}}}}}};
  const Result<FbxScene> scene = read_fbx_scene(make_fbx_scene(kModels, stacks), "in.fbx");
  ASSERT_TRUE(scene.ok()) << scene.error().message;
  const auto& frames = scene->motions[0].frames;
  EXPECT_EQ(frames.at(2).size(), 11u);
  ASSERT_EQ(scene->nodes[5].name, "prop");
  EXPECT_EQ(frames.at(5).size(), 1u);
  EXPECT_EQ(frames.size(), 2u);
}

}  // namespace
}  // namespace panache::test
