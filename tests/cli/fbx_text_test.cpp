// FBX whose meshes Assimp does not read: version 6, and text with what it rejects.

#include "clip/binary_fbx.h"
#include "cli/fbx_program_test.h"
#include "clip/make_fbx6.h"
#include "clip/make_fbx6_curves.h"
#include "cli/same_positions.h"

namespace panache::test {
namespace {

// Angles and places in the file have at least six decimals, and floats carry them: along seven
// joints of half a metre, and pivots of 6 cm, less than this. Metres.
constexpr float kPositionTolerance = 2e-5f;

class FbxText : public FbxProgramTest {
 protected:
  void expect_is(const Clip& walk, const std::string& bytes) {
    write("in.fbx", bytes);
    for (const std::string name : {"out.bvh", "out.glb"}) {
      SCOPED_TRACE(name);
      const Ran ran = must({"convert", "in.fbx", "--force", "-o", name});
      const auto file = read_motion(path(name));
      ASSERT_TRUE(file.ok()) << file.error().message;
      expect_same_positions(walk, (*file)->clip(), kPositionTolerance);
    }
  }
  std::string rejection(const std::string& bytes) {
    write("in.fbx", bytes);
    const Ran ran = run("info in.fbx");
    EXPECT_EQ(ran.exit, 1) << ran.out;
    EXPECT_EQ(std::count(ran.err.begin(), ran.err.end(), '\n'), 1) << ran.err;
    return ran.err;
  }
};

std::string changed(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

TEST_F(FbxText, version_6_keeps_places_in_every_rotation_order_and_unit) {
  const Clip walk = walking_clip(20);
  for (int order = 0; order < 6; ++order) {
    SCOPED_TRACE(order);
    const std::string text = Fbx6Maker(walk, order, order == 3 ? 2.54 : 1).make();
    expect_is(walk, order % 2 ? to_binary_fbx6(text) : text);
  }
}

// Every joint below the root turns, some grow around a pivot, some hold their keys, and no two axes
// have their keys at the same times.
const std::vector<CurveModel> kChain = {
    {"root", -1, {{"Lcl Translation", {0, 90, 0}}}},
    {"held", 0, {{"Lcl Translation", {10, 20, 0}}, {"Lcl Rotation", {0, 10, 0}}}},
    {"grown",
     1,
     {{"Lcl Translation", {0, 30, 5}},
      {"Lcl Rotation", {5, 0, 0}},
      {"RotationOffset", {1, -2, 0.5}},
      {"RotationPivot", {2, 3, -4}},
      {"ScalingOffset", {-1, 2, 3}},
      {"ScalingPivot", {4, -3, 6}},
      {"Lcl Scaling", {1.5, 1.5, 1.5}}}},
    {"turned", 2, {{"Lcl Translation", {0, 25, 0}}, {"Lcl Scaling", {1, -1, 1}}}},
    {"still", 3, {{"Lcl Translation", {3, 12, -4}}, {"Lcl Rotation", {20, 30, 40}}}},
    {"uneven",
     4,
     {{"Lcl Translation", {8, 6, 4}}, {"ScalingPivot", {1, 2, 3}}, {"Lcl Scaling", {2, 0.5, 1}}}},
    {"below it", 5, {{"Lcl Translation", {8, 6, 4}}, {"RotationPivot", {2, -1, 1}}}},
    {"leaf", 6, {{"Lcl Translation", {4, -2, 7}}}}};
const std::vector<CurveTake> kChainTakes = {
    {"First",
     {{0, {{{{{{0, 0}, {24, 60}}, {{6, 90}, {13, 95}}, {}}}, {}, {}}}},
      {1,
       {{{{{{0, 10, true}, {7, 14, true}, {15, 10}}, {{4, 20, true}, {21, 26}}, {}}},
         {{{{0, 0, true}, {11, 40}}, {}, {{3, 0, true}, {9, 25, true}, {19, -20}}}},
         {}}}},
      {2,
       {{{},
         {{{{2, 5}, {14, 65}}, {}, {}}},
         {{{{0, 1.5}, {24, 0.5}}, {{0, 1.5}, {24, 0.5}}, {{0, 1.5}, {24, 0.5}}}}}}},
      {3, {{{}, {{{{1, 0}, {20, 90}}, {{5, -30}, {17, 30}}, {{0, 0}, {12, 50}, {24, 0}}}}, {}}}},
      {5, {{{}, {}, {{{{0, 2, true}, {10, 3}}, {}, {{8, 1}, {16, 2}}}}}}},
      {6, {{{}, {{{{3, 0}, {13, 40}}, {}, {{0, 0}, {20, 90}}}}, {}}}},
      {7, {{{}, {{{}, {{4, 0}, {5, 1}}, {}}}, {}}}}}},
    {"No keys", {{1, {}}}},
    {"Places alone", {{0, {{{{{{3, 0}, {13, 20}, {22, 0}}, {}, {}}}, {}, {}}}}}},
};

TEST_F(FbxText, keys_at_any_times_and_scales_around_pivots_are_as_the_formula_says) {
  const std::string text = format_fbx6(kChain, kChainTakes);
  for (const std::string& bytes : {text, to_binary_fbx6(text)}) {
    write("in.fbx", bytes);
    must("convert in.fbx --force -o out.glb");
    const auto glb = read_motion(path("out.glb"));
    ASSERT_TRUE(glb.ok()) << glb.error().message;
    ASSERT_EQ((*glb)->clip_names(), (std::vector<std::string>{"First", "Places alone"}));
    for (const size_t t : {0, 2}) {
      const CurveTake& take = kChainTakes[t];
      must({"convert", "in.fbx", "--clip", take.name, "--force", "-o", "out.bvh"});
      const auto bvh = read_motion(path("out.bvh"));
      ASSERT_TRUE(bvh.ok()) << bvh.error().message;
      const int first = t == 0 ? 0 : 3, frames = t == 0 ? 25 : 20;
      Clip expected;
      for (const CurveModel& model : kChain) {
        expected.skeleton.joints.emplace_back().name = model.name;
      }
      expected.frame_time = 1 / kCurveRate;
      expected.resize(frames);
      for (int f = 0; f < frames; ++f) {
        for (size_t m = 0; m < kChain.size(); ++m) {
          expected.pose(f).rotations[m] = {};
          expected.pose(f).translations[m] =
              position_by_formula(kChain, take, m, first + f).as<float>();
        }
      }
      expect_same_positions(expected, (*glb)->clip(t == 0 ? 0 : 1), kPositionTolerance);
      expect_same_positions(expected, (*bvh)->clip(), kPositionTolerance);
    }
  }
}

TEST_F(FbxText, keys_a_tick_apart_are_one) {
  const Clip walk = walking_clip(20);
  // The second key of the first curve.
  const std::string seven = changed(format_fbx(walk), ",1539538600,", ",1539538601,");
  expect_is(walk, seven);
  expect_is(walk, changed(seven, "FBXVersion: 7400", "FBXVersion: 7000"));
  // It begins at 2 s.
  expect_is(walk, changed(Fbx6Maker(walk, 0, 1).make(), "93911854600,", "93911854601,"));
}

TEST_F(FbxText, a_rate_that_is_not_that_of_the_keys_changes_nothing) {
  const Clip walk = walking_clip(20, 50);
  const std::string text = Fbx6Maker(walk, 0, 1).make();
  for (const char* rate : {"24", "48", "120"}) {
    SCOPED_TRACE(rate);
    expect_is(walk, changed(text, "FrameRate: \"30\"", "FrameRate: \"" + std::string(rate) + "\""));
  }
}

TEST_F(FbxText, names_may_have_any_bytes) {
  // The third is Latin-1.
  const std::string names[] = {"The root",
                               "H\xc3\xbc"
                               "fte \xe8\x85\xb0",
                               "Fu\xdf", "a:b{c},;d", "rig::head"};
  std::vector<CurveModel> models = kChain;
  for (size_t i = 0; i < std::size(names); ++i) models[i].name = names[i];
  std::vector<CurveTake> takes = kChainTakes;
  takes[0].name =
      "Gehen, gr\xf6\xdf"
      "er";
  takes[2].name = "Caf\xc3\xa9: 2";
  const std::string text = format_fbx6(models, takes);
  for (const std::string& bytes : {text, to_binary_fbx6(text)}) {
    write("in.fbx", bytes);
    must("convert in.fbx --force -o out.glb");
    const auto file = read_motion(path("out.glb"));
    ASSERT_TRUE(file.ok()) << file.error().message;
    EXPECT_EQ((*file)->clip_names(), (std::vector<std::string>{"Gehen, gr\ufffd\ufffd"
                                                               "er",
                                                               "Caf\u00e9: 2"}));
    for (const std::string& name : names) {
      const auto& joints = (*file)->clip().skeleton.joints;
      EXPECT_TRUE(std::ranges::count(joints, name == names[2] ? "Fu\ufffd" : name, &Joint::name))
          << name;
    }
  }
}

TEST_F(FbxText, Assimp_reads_names_of_any_bytes_too) {
  FbxOptions options;
  options.motion =
      "gr\xf6\xdf"
      "er";
  const std::string text =
      changed(format_fbx(walking_clip(5), options), "Model::head", "Model::h\xe9");
  write("in.fbx", text);
  must("convert in.fbx --force -o out.glb");
  const auto file = read_motion(path("out.glb"));
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ((*file)->clip_names(), (std::vector<std::string>{"gr\ufffd\ufffd"
                                                             "er"}));
}

TEST_F(FbxText, stylize_adds_a_motion_and_cameras_are_no_joints) {
  write("in.fbx", Fbx6Maker(walking_clip(40), 0, 1).make());
  must("stylize in.fbx --style old=1 -o out.glb");
  const auto file = read_motion(path("out.glb"));
  ASSERT_TRUE(file.ok());
  EXPECT_EQ((*file)->clip_names(), (std::vector<std::string>{"Walk (old 1)", "Walk"}));
  EXPECT_FALSE(holds(read("out.glb"), "Producer"));
}

TEST_F(FbxText, a_note_says_that_meshes_are_left_out) {
  const std::string six = Fbx6Maker(walking_clip(40), 0, 1).make();
  const std::string six_mesh =
      changed(six, "Objects:  {\n",
              "Objects:  {\n\tModel: \"Model::Body\", \"Mesh\" {\n\t\tVertices: 0,0,0,1,0,0,0,1,0\n"
              "\t\tPolygonVertexIndex: 0,1,-3\n\t}\n");
  const std::string seven =
      changed(format_fbx(walking_clip(40)), "FBXVersion: 7400", "FBXVersion: 7000");
  const std::string seven_mesh = changed(
      seven, "Objects:  {\n",
      "Objects:  {\n\tGeometry: 7, \"Geometry::\", \"Mesh\" {\n\t\tVertices: *9 {\n\t\t\ta: "
      "0,0,0,1,0,0,0,1,0\n\t\t}\n\t\tPolygonVertexIndex: *3 {\n\t\t\ta: 0,1,-3\n\t\t}\n\t}\n");
  const std::string note =
      "panache: in.fbx: its meshes are left out, as Assimp cannot read them; exporting it again, "
      "as "
      "FBX 7 or as GLB, may help\n";
  const std::vector<std::pair<std::string, std::string>> expected = {
      {six, ""},   {six_mesh, note},   {to_binary_fbx6(six), ""}, {to_binary_fbx6(six_mesh), note},
      {seven, ""}, {seven_mesh, note},
  };
  for (const auto& [bytes, said] : expected) {
    write("in.fbx", bytes);
    const bool is_six = bytes == six_mesh || bytes == to_binary_fbx6(six_mesh);
    const std::string info = run("info in.fbx").err;
    EXPECT_EQ(info.find("panache: in.fbx: is FBX 6, which is written as FBX 7") == 0, is_six)
        << info;
    const Ran ran = must("stylize in.fbx --style old=1 --force -o out.glb");
    EXPECT_EQ(ran.err, said);
  }
}

// That no damaged file does harm is tests/clip/fbx_safety_test.cpp.
TEST_F(FbxText, what_is_wrong_is_told_with_its_line) {
  const std::string good = Fbx6Maker(walking_clip(5), 0, 1).make();
  EXPECT_EQ(rejection(changed(good, "FBXVersion: 6100", "FBXVersion  6100")),
            "panache: in.fbx:3:2: expected a name with a colon behind it, found 'FBXVersion'\n");
  std::string deep = good, longer = to_binary_fbx6(good);
  for (int i = 0; i < 10'000; ++i) deep += "A: {";
  longer[27 + 3] = 1;  // The end of the first node.
  const std::string unit = "\"UnitScaleFactor\", \"double\", \"A+\",";
  const std::pair<std::string, const char*> cases[] = {
      {changed(good, "KeyCount: 5", "KeyCount: 6"),
       "expected a KeyCount of 5, as there are keys, found '6'"},
      {changed(good, "FBXVersion: 6100", "FBXVersion: 5000"), "Autodesk's FBX Converter"},
      {changed(good, unit + "1.0", unit + "nan"),
       "expected a number between -1e9 and 1e9 for 'UnitScaleFactor'"},
      {deep, "expected at most 64 open braces"},
      {longer, "expected binary FBX, found something else at byte"},
  };
  for (const auto& [bytes, part] : cases) EXPECT_TRUE(holds(rejection(bytes), part));
}

TEST_F(FbxText, a_small_file_of_a_long_motion_is_rejected_at_once) {
  const std::vector<CurveModel> models = {{"root", -1, {}}};
  const auto make = [&](double frames) {
    return format_fbx6(models, {{"Long", {{0, {{{{{{0, 0}, {frames, 1}}, {}, {}}}, {}, {}}}}}}});
  };
  for (const double frames : {1.1e6, 1.5e7, 4e7}) {
    EXPECT_TRUE(holds(rejection(make(frames)), "is the time of a key wrong?")) << frames;
  }
  EXPECT_TRUE(holds(rejection(make(1e9)), "expected a time within 18 days, found '15"));
  EXPECT_TRUE(holds(rejection(changed(make(9), "Key: 0,", "Key: -9223372036854775808,")),
                    "expected a time within 18 days, found '-9223372036854775808'"));
  write("in.fbx", make(100'000));
  EXPECT_TRUE(holds(run("info in.fbx").out, "100001 frames"));
}

}  // namespace
}  // namespace panache::test
