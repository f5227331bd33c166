// FBX is read as the manual of its maker says: the chain of a node's transforms, and its animation.

#include <gtest/gtest.h>

#include "base/file.h"
#include "clip/binary_fbx.h"
#include "clip/fbx.h"
#include "clip/make_fbx_scene.h"
#include "make_clip.h"

namespace panache {
namespace {

using test::SceneCurve;
using test::SceneLayer;
using test::SceneModel;
using test::SceneStack;
using test::SceneTransform;
using test::world_positions;

// Positions are floats of at most 10 m along chains of at most eight joints, whose rotations are
// floats. Metres.
constexpr float kTolerance = 1e-5f;

std::unique_ptr<MotionFile> read_fbx(const std::string& bytes) {
  auto file = parse_fbx(bytes, "in.fbx");
  EXPECT_TRUE(file.ok()) << file.error().message;
  return file ? *std::move(file) : nullptr;
}

size_t joint_called(const Clip& clip, const std::string& name, size_t which = 0) {
  for (size_t j = 0; j < clip.joints(); ++j) {
    if (clip.skeleton.joints[j].name == name && which-- == 0) return j;
  }
  ADD_FAILURE() << "no joint " << name;
  return 0;
}

void expect_at(const Clip& clip, int frame, const std::string& name, Vec3 position,
               float tolerance = kTolerance) {
  EXPECT_LE(length(world_positions(clip, frame)[joint_called(clip, name)] - position), tolerance)
      << name << " in frame " << frame;
}

double value_of(const SceneCurve& curve, double frame, double still) {
  if (curve.keys.empty()) return still;
  std::vector<test::CurveKey> keys;
  for (const test::SceneKey& key : curve.keys) keys.push_back({key.frame, key.value, false});
  return test::value_at(keys, frame);
}

// The clip's joints are where the formula has the models of the same names, whose numbers at a
// frame are `transforms`.
void expect_positions(const Clip& clip, const std::vector<SceneModel>& models,
                      const std::vector<std::vector<SceneTransform>>& transforms) {
  ASSERT_EQ(clip.frames, static_cast<int>(transforms.size()));
  for (int f = 0; f < clip.frames; ++f) {
    const std::vector<Vec3> got = world_positions(clip, f);
    const std::vector<Vec3d> expected =
        test::positions_by_formula(models, transforms[static_cast<size_t>(f)]);
    for (size_t m = 0; m < models.size(); ++m) {
      const Vec3 metres = (expected[m] * 0.01).as<float>();
      ASSERT_LE(length(got[joint_called(clip, models[m].name)] - metres), kTolerance)
          << models[m].name << " in frame " << f;
    }
  }
}

// The chain's every part, in animated joints, still ones and props.
const std::vector<SceneModel> kChain = {
    {"root", -1, {{"Lcl Translation", {0, 90, 0}}, {"InheritType", {0}}}},
    {"pivoted",
     0,
     {{"Lcl Translation", {10, 20, 0}},
      {"Lcl Rotation", {0, 10, 0}},
      {"RotationOffset", {1, -2, 0.5}},
      {"RotationPivot", {2, 3, -4}},
      {"ScalingOffset", {-1, 2, 3}},
      {"ScalingPivot", {4, -3, 6}},
      {"Lcl Scaling", {1.5, 1.5, 1.5}},
      {"PreRotation", {20, -30, 40}},
      {"PostRotation", {-15, 25, 5}},
      {"RotationOrder", {4}}}},
    {"still",
     1,
     {{"Lcl Translation", {3, 12, -4}},
      {"Lcl Rotation", {20, 30, 40}},
      {"RotationPivot", {-2, 5, 1}},
      {"PreRotation", {5, 6, 7}},
      {"RotationOrder", {2}}}},
    {"small", 2, {{"Lcl Translation", {0, 25, 0}}, {"Lcl Scaling", {0.5, 0.5, 0.5}}}},
    {"compensated", 3, {{"Lcl Translation", {4, -2, 7}}, {"InheritType", {2}}}},
    {"leaf", 4, {{"Lcl Translation", {4, -2, 7}}}},
    {"prop",
     1,
     {{"Lcl Translation", {8, 6, 4}},
      {"RotationPivot", {2, -1, 1}},
      {"ScalingPivot", {1, 2, 3}},
      {"Lcl Scaling", {2, 0.5, 1}}},
     "Mesh"},
};

SceneCurve line(double begin, double end, double last = 10) { return {{{0, begin}, {last, end}}}; }

const std::vector<test::SceneCurves> kChainCurves = {
    {0, 0, {{line(0, 30), line(90, 95), {}}}},
    {1, 1, {{line(-40, 50), line(0, 20), line(70, -10)}}},
    {3, 1, {{line(0, 90), {}, line(10, -60)}}},
    {4, 1, {{line(0, 45), line(0, -30), {}}}},
    {6, 1, {{{}, line(0, 120), {}}}},
};

// What the chain's numbers are at a frame, with curves of one layer alone.
std::vector<SceneTransform> chain_at(const std::vector<SceneModel>& models,
                                     const std::vector<test::SceneCurves>& curves, double frame) {
  std::vector<SceneTransform> out;
  for (const SceneModel& model : models) out.push_back(test::saved_transform(model));
  for (const test::SceneCurves& of : curves) {
    for (size_t axis = 0; axis < 3; ++axis) {
      double& number = out[of.model][static_cast<size_t>(of.part)][axis];
      // An axis without a curve stays as the model has it.
      number = value_of(of.axes[axis], frame, number);
    }
  }
  return out;
}

TEST(FbxRead, every_part_of_the_chain_counts_for_joints_and_props_in_text_and_binary) {
  const std::string text =
      test::make_fbx_scene(kChain, {{"Take", {{"BaseLayer", {}, kChainCurves}}}});
  std::vector<std::vector<SceneTransform>> transforms;
  for (int f = 0; f <= 10; ++f) transforms.push_back(chain_at(kChain, kChainCurves, f));
  std::vector<std::string> files = {
      text, test::make_fbx_scene(kChain, {{"Take", {{"BaseLayer", {}, kChainCurves}}}},
                                 {.reversed = true})};
  for (const int version : {7100, 7200, 7300, 7400, 7500, 7600, 7700}) {
    for (const bool packed : {false, true}) {
      files.push_back(test::to_binary_fbx7(text, version, packed));
    }
  }
  for (const std::string& bytes : files) {
    const auto file = read_fbx(bytes);
    ASSERT_TRUE(file);
    EXPECT_EQ(file->clip_names(), std::vector<std::string>{"Take"});
    expect_positions(file->clip(), kChain, transforms);
  }
}

TEST(FbxRead, models_inherit_scales_as_they_say) {
  for (const double type : {0.0, 1.0, 2.0}) {
    SCOPED_TRACE(type);
    std::vector<SceneModel> models = kChain;
    models[3].numbers["Lcl Scaling"] = {0.5, 2, 1};
    models[4].numbers["InheritType"] = {type};
    models[5].numbers["InheritType"] = {type};
    std::vector<std::vector<SceneTransform>> transforms;
    for (int f = 0; f <= 10; ++f) transforms.push_back(chain_at(models, kChainCurves, f));
    const auto file =
        read_fbx(test::make_fbx_scene(models, {{"Take", {{"BaseLayer", {}, kChainCurves}}}}));
    ASSERT_TRUE(file);
    expect_positions(file->clip(), models, transforms);
  }
}

TEST(FbxRead, a_file_of_another_unit_and_axes_is_in_metres_with_y_up) {
  // X at the side and Z up: the file's (x, y, z) is (x, z, -y).
  const std::vector<SceneModel> models = {{"root", -1, {{"Lcl Translation", {1, 2, 3}}}},
                                          {"leaf", 0, {{"Lcl Translation", {10, 20, 30}}}}};
  const auto file = read_fbx(
      test::make_fbx_scene(models, {}, {.centimetres = 2.54, .up_axis = 2, .side_axis = 0}));
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->clip_names().empty());
  expect_at(file->clip(), 0, "leaf", Vec3{11, 33, -22} * 0.0254f);
}

// ---- curves

double at_frame(const SceneCurve& curve, int frame) {
  const std::vector<SceneModel> models = {{"root", -1, {}}, {"leaf", 0, {}}};
  const SceneCurve dense = line(0, 1, 20);
  std::vector<test::SceneCurves> curves = {{0, 0, {{curve, {}, {}}}}};
  // A key in every frame tells the rate.
  SceneCurve every;
  for (int f = 0; f <= 20; ++f) every.keys.push_back({static_cast<double>(f), f * 0.1});
  curves.push_back({1, 0, {{every, {}, {}}}});
  const auto file = read_fbx(test::make_fbx_scene(models, {{"Take", {{"BaseLayer", {}, curves}}}}));
  if (!file || file->clip().frames != 21) {
    ADD_FAILURE();
    return 0;
  }
  return static_cast<double>(file->clip().pose(frame).translations[0].x) * 100;
}

TEST(FbxRead, steps_stay_steps) {
  SceneCurve step = {{{0, 10}, {7, 20}, {14, 5}, {20, 5}}, 2};
  EXPECT_NEAR(at_frame(step, 6), 10, 1e-4);
  EXPECT_NEAR(at_frame(step, 7), 20, 1e-4);
  EXPECT_NEAR(at_frame(step, 13), 20, 1e-4);
  step.flags = 0x102;  // The value of the next key.
  EXPECT_NEAR(at_frame(step, 1), 20, 1e-4);
  EXPECT_NEAR(at_frame(step, 7), 20, 1e-4);
  EXPECT_NEAR(at_frame(step, 8), 5, 1e-4);
}

TEST(FbxRead, cubic_keys_follow_the_slopes_of_the_file) {
  // Hermite: slopes of 30 and -60 a second over 20 frames at 30 a second.
  SceneCurve curve = {{{0, 10}, {20, 40}}, 0x8 | 0x400, {30, -60, 0, 0}};
  const double t = 5.0 / 20, d = 20.0 / 30;
  const double expected = (2 * t * t * t - 3 * t * t + 1) * 10 +
                          d * (t * t * t - 2 * t * t + t) * 30 + (3 * t * t - 2 * t * t * t) * 40 +
                          d * (t * t * t - t * t) * -60;
  EXPECT_NEAR(at_frame(curve, 5), expected, 1e-4);
}

TEST(FbxRead, weighted_tangents_are_bezier_handles) {
  // Handles that reach over 0.6 and 0.2 of the time, at slope 0: u with 3 u (1-u)^2 0.6 + 3 u^2
  // (1-u) 0.8 + u^3 = 0.5 has the value 3 u^2 - 2 u^3.
  SceneCurve curve = {{{0, 0}, {20, 100}}, 0x8 | 0x400 | 0x3000000, {0, 0, 0, 0}};
  curve.data[2] = std::bit_cast<float>(uint32_t{1999u << 16 | 5999u});
  double low = 0, high = 1;
  for (int i = 0; i < 50; ++i) {
    const double u = (low + high) / 2, v = 1 - u;
    (3 * u * v * v * 0.59996 + 3 * u * u * v * 0.80008 + u * u * u < 0.5 ? low : high) = u;
  }
  EXPECT_NEAR(at_frame(curve, 10), 100 * (3 * low * low - 2 * low * low * low), 1e-2);
}

TEST(FbxRead, automatic_slopes_are_parallel_to_the_neighbours) {
  const SceneCurve curve = {{{0, 0}, {10, 10}, {20, 60}}, 0x8 | 0x100};
  // The slope at the middle key is 60 over 20 frames; at the ends it is 0.
  const double slope = 60 / (20.0 / 30), d = 10.0 / 30;
  EXPECT_NEAR(at_frame(curve, 5), 0.5 * 10 + d * 0 - 0.125 * d * slope, 1e-4);
}

// ---- layers

// A joint with a base layer and another, as the numbers of its rotation at frame 5.
struct Layered {
  std::map<std::string, double> numbers;
  Vec3d expected;
  bool are_rotations = false;
};

TEST(FbxRead, layers_add_up_in_any_order_of_connections) {
  const std::vector<SceneModel> models = {{"root", -1, {}},
                                          {"arm", 0, {{"Lcl Translation", {0, 10, 0}}}},
                                          {"hand", 1, {{"Lcl Translation", {30, 5, -8}}}}};
  const std::vector<test::SceneCurves> base = {
      {1, 1, {{line(0, 40), line(10, 30), line(-80, 20)}}}};
  const std::vector<test::SceneCurves> over = {{1, 1, {{line(20, 20), line(0, 0), line(20, 40)}}}};
  const Vec3d own = {20, 20, -30}, other = {20, 0, 30};
  const std::vector<Layered> cases = {
      {{}, own + other},
      {{{"Weight", 100}, {"BlendMode", 0}}, own + other},
      {{{"Weight", 50}, {"BlendMode", 0}, {"RotationAccumulationMode", 1}}, own + other * 0.5},
      {{{"Weight", 100}, {"BlendMode", 0}, {"RotationAccumulationMode", 0}}, other, true},
      {{{"Weight", 100}, {"BlendMode", 1}}, other},
      {{{"Weight", 25}, {"BlendMode", 2}}, own * 0.75 + other * 0.25},
      {{{"Weight", 0}, {"BlendMode", 1}}, own},
      {{{"Mute", 1}}, own},
  };
  for (const Layered& layered : cases) {
    for (const bool reversed : {false, true}) {
      SCOPED_TRACE(testing::PrintToString(layered.numbers) + (reversed ? " reversed" : ""));
      const auto file = read_fbx(test::make_fbx_scene(
          models, {{"Take", {{"BaseLayer", {}, base}, {"Layer2", layered.numbers, over}}}},
          {.reversed = reversed}));
      ASSERT_TRUE(file);
      std::vector<SceneTransform> transforms;
      for (const SceneModel& model : models) transforms.push_back(test::saved_transform(model));
      Vec3d hand;
      if (layered.are_rotations) {
        using test::operator*;
        const test::Affine both = test::affine_turn(own) * test::affine_turn(other);
        const test::Affine at = both * test::affine_move({30, 5, -8});
        hand = {at[0][3], at[1][3] + 10, at[2][3]};
      } else {
        transforms[1][1] = layered.expected;
        hand = test::positions_by_formula(models, transforms)[2];
      }
      expect_at(file->clip(), 5, "hand", (hand * 0.01).as<float>());
    }
  }
}

TEST(FbxRead, a_layer_alone_adds_to_what_was_saved) {
  const std::vector<SceneModel> models = {{"root", -1, {}},
                                          {"arm", 0, {{"Lcl Rotation", {0, 0, 30}}}},
                                          {"hand", 1, {{"Lcl Translation", {100, 0, 0}}}}};
  const auto file = read_fbx(
      test::make_fbx_scene(models, {{"Take",
                                     {{"BaseLayer", {}, {{0, 0, {{line(0, 0), {}, {}}}}}},
                                      {"Layer2", {}, {{1, 1, {{{}, {}, line(0, 60)}}}}}}}}));
  ASSERT_TRUE(file);
  expect_at(file->clip(), 10, "hand", {0, 1, 0});
}

TEST(FbxRead, each_stack_is_a_motion) {
  const std::vector<SceneModel> models = {{"root", -1, {}}, {"leaf", 0, {}}};
  const auto stack = [&](const std::string& name, double end) {
    return SceneStack{name, {{"BaseLayer", {}, {{0, 0, {{line(0, end), {}, {}}}}}}}};
  };
  const auto file = read_fbx(
      test::make_fbx_scene(models, {stack("walk", 10), stack("run", 20), stack("run", 30)}));
  ASSERT_TRUE(file);
  EXPECT_EQ(file->clip_names(), (std::vector<std::string>{"walk", "run", "run (2)"}));
  expect_at(file->clip(1), 10, "leaf", {0.2f, 0, 0});
  expect_at(file->clip(2), 10, "leaf", {0.3f, 0, 0});
}

TEST(FbxRead, curves_belong_to_objects_and_not_to_names) {
  std::vector<SceneModel> models;
  std::vector<test::SceneCurves> curves;
  std::vector<std::vector<SceneTransform>> transforms(11);
  for (size_t figure = 0; figure < 3; ++figure) {
    const int first = static_cast<int>(models.size());
    models.push_back({"hips", -1, {{"Lcl Translation", {0, 90, 0}}}});
    models.push_back({"spine", first, {{"Lcl Translation", {0, 20, 0}}}});
    models.push_back({"spine", first + 1, {{"Lcl Translation", {0, 20, 0}}}});
    const double by = 10 * static_cast<double>(figure + 1);
    curves.push_back({models.size() - 3, 0, {{line(0, by), {}, {}}}});
    curves.push_back({models.size() - 2, 1, {{line(0, -by), {}, {}}}});
  }
  for (const bool reversed : {false, true}) {
    const auto file = read_fbx(test::make_fbx_scene(models, {{"Take", {{"BaseLayer", {}, curves}}}},
                                                    {.reversed = reversed}));
    ASSERT_TRUE(file);
    for (const int f : {0, 5, 10}) {
      const std::vector<Vec3> got = world_positions(file->clip(), f);
      std::vector<Vec3d> expected = test::positions_by_formula(models, chain_at(models, curves, f));
      // Joints are level by level, so any order will do that has all of them.
      for (const Vec3d position : expected) {
        EXPECT_TRUE(std::ranges::any_of(got, [&](Vec3 p) {
          return length(p - (position * 0.01).as<float>()) <= kTolerance;
        })) << f;
      }
    }
  }
}

// ---- files of others that went wrong

std::unique_ptr<MotionFile> read_fixture(const std::string& name) {
  const Result<std::string> bytes =
      read_file(PANACHE_SOURCE_DIR "/tests/fixtures/fbx/" + name + ".fbx");
  EXPECT_TRUE(bytes.ok());
  return bytes ? read_fbx(*bytes) : nullptr;
}

// The places were found by multiplying the matrices of the chain in another program; it prints five
// decimals.
constexpr float kPrinted = 2e-5f;

TEST(FbxRead, files_that_other_readers_got_wrong_are_where_they_should_be) {
  const struct {
    const char* file;
    int frame;
    const char* joint;
    Vec3 position;
  } cases[] = {// A thigh turns about its pivot.
               {"pivots", 0, "leftToes", {0.02825f, -0.01584f, 0.30787f}},
               {"pivots", 6, "leftToes", {0.04685f, 0.00670f, 0.36641f}},
               {"pivots", 13, "leftToes", {0.04052f, 0.06302f, 0.43421f}},
               {"pivots", 13, "rightHand", {-0.11095f, 0.77380f, 0.78431f}},
               // A layer comes on top.
               {"additive-layer", 0, "leftHand", {0.31450f, 0.80600f, -0.13788f}},
               {"additive-layer", 6, "leftHand", {0.33047f, 0.87245f, 0.50772f}},
               {"additive-layer", 13, "leftHand", {0.34619f, 0.85968f, 1.02632f}},
               {"additive-layer", 13, "rightHand", {-0.11095f, 0.77380f, 0.78431f}},
               // Two figures have motions of their own.
               {"two-figures-equal-names", 2, "leftHand", {0.17082f, 0.75842f, 0.06802f}},
               {"two-figures-equal-names", 2, "leftHand (2)", {1.17077f, 0.75842f, 0.06802f}}};
  for (const auto& [name, frame, joint, position] : cases) {
    SCOPED_TRACE(name);
    const auto file = read_fixture(name);
    ASSERT_TRUE(file);
    expect_at(file->clip(), frame, joint, position, kPrinted);
  }
  const auto file = read_fixture("pivots");
  EXPECT_EQ(file->clip().frames, 14);
  EXPECT_NEAR(file->clip().frame_time, 0.05, 1e-9);
}

}  // namespace
}  // namespace panache
