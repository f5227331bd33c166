// FBX that Assimp does not read: version 6, and text with what it rejects.

#include "cli/make_fbx.h"
#include "cli/make_fbx6.h"
#include "cli/program.h"
#include "cli/same_positions.h"

namespace panache::test {
namespace {

// Angles and places in the file have at least six decimals, and floats carry them: along seven
// joints of half a metre, and pivots of 6 cm, less than this. Metres.
constexpr float kPlaceTolerance = 2e-5f;

class FbxText : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("walk.fbx", format_fbx(walking_clip(5)));
    if (run({"info", "walk.fbx"}).err.find("this build reads no FBX files") != std::string::npos) {
      GTEST_SKIP() << "this build has no Assimp";
    }
  }
  void expect_is(const Clip& walk, const std::string& bytes) {
    write("in.fbx", bytes);
    for (const std::string name : {"out.bvh", "out.glb"}) {
      SCOPED_TRACE(name);
      const Ran ran = run({"convert", "in.fbx", "--force", "-o", name});
      ASSERT_EQ(ran.exit, 0) << ran.err;
      const auto file = read_motion(path(name));
      ASSERT_TRUE(file.ok()) << file.error().message;
      expect_same_positions(walk, (*file)->clip(), kPlaceTolerance);
    }
  }
  std::string rejection(const std::string& bytes) {
    write("in.fbx", bytes);
    const Ran ran = run({"info", "in.fbx"});
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
    expect_is(walk, Fbx6Maker(walk, order, order == 3 ? 2.54 : 1).make());
  }
}

TEST_F(FbxText, version_7_text_that_Assimp_rejects_keeps_places) {
  const Clip walk = walking_clip(20);
  FbxOptions options;
  options.pre_rotation = normalized(Quat{0.3f, -0.5f, 0.2f, 0.7f});
  options.z_up = true;
  const std::string text = format_fbx(walk, options);
  expect_is(walk, changed(text, "FBXVersion: 7400", "FBXVersion: 7000"));
}

TEST_F(FbxText, stylize_adds_a_motion_and_cameras_are_no_joints) {
  write("in.fbx", Fbx6Maker(walking_clip(40), 0, 1).make());
  const Ran ran = run({"stylize", "in.fbx", "--style", "old=1", "-o", "out.glb"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto file = read_motion(path("out.glb"));
  ASSERT_TRUE(file.ok());
  EXPECT_EQ((*file)->clip_names(), (std::vector<std::string>{"Walk", "Walk (old 1)"}));
  EXPECT_EQ(read("out.glb").find("Producer"), std::string::npos);
}

TEST_F(FbxText, a_damaged_file_is_rejected_with_its_line) {
  const std::string good = Fbx6Maker(walking_clip(5), 0, 1).make();
  for (size_t size = 100; size < good.size() - 2; size += good.size() / 23) {
    EXPECT_TRUE(rejection(good.substr(0, size)).starts_with("panache: in.fbx:")) << size;
  }
  EXPECT_EQ(rejection(changed(good, "FBXVersion: 6100", "FBXVersion  6100")),
            "panache: in.fbx:3:2: expected a name with a colon behind it, found 'FBXVersion'\n");
  EXPECT_NE(rejection(changed(good, "KeyCount: 5", "KeyCount: 6"))
                .find("expected a KeyCount of 5, as there are keys, found '6'"),
            std::string::npos);
  EXPECT_NE(rejection(changed(good, "FBXVersion: 6100", "FBXVersion: 5000"))
                .find("Autodesk's FBX Converter"),
            std::string::npos);
  EXPECT_NE(rejection(changed(good, "\"UnitScaleFactor\", \"double\", \"A+\",1.0",
                              "\"UnitScaleFactor\", \"double\", \"A+\",nan"))
                .find("expected a number between -1e9 and 1e9 for 'UnitScaleFactor'"),
            std::string::npos);
  std::string deep = good;
  for (int i = 0; i < 10'000; ++i) deep += "A: {";
  EXPECT_NE(rejection(deep).find("expected at most 64 open braces"), std::string::npos);
}

TEST_F(FbxText, models_in_a_circle_are_rejected) {
  EXPECT_NE(rejection("; FBX 6.1.0 project file\nObjects: {\n Model: \"Model::a\", \"Limb\" {\n }\n"
                      " Model: \"Model::b\", \"Limb\" {\n }\n}\nConnections: {\n"
                      " Connect: \"OO\", \"Model::a\", \"Model::b\"\n"
                      " Connect: \"OO\", \"Model::b\", \"Model::a\"\n}\n")
                .find("in a circle"),
            std::string::npos);
}

}  // namespace
}  // namespace panache::test
