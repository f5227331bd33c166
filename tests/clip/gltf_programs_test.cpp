// What other people's programs make of our files: the Khronos validator, and three.js in Chromium.
// Skipped where Node, Chromium or the packages of tests/web are not there.

#include <cstdlib>

#include "gltf_checks.h"
#include "make_clip.h"
#include "rig/body_mesh.h"
#include "temporary_folder.h"

namespace panache {
namespace {

using test::GltfParts;
using test::Json;

const std::string kWeb = PANACHE_SOURCE_DIR "/tests/web/";

bool has_program(const std::string& name) {
  return std::system(("command -v " + name + " > /dev/null 2>&1").c_str()) == 0;
}
// What is missing for these tests, or "".
std::string missing(bool browser) {
  if (!has_program("node")) return "there is no node";
  if (!std::filesystem::exists(kWeb + "node_modules")) return "npm ci was not run in tests/web";
  if (browser && !has_program("chromium")) return "there is no chromium";
  return "";
}

class GltfPrograms : public testing::Test {
 protected:
  // Runs a script of tests/web in the folder; what it says on both streams where it fails.
  std::string run(const std::string& script, const std::string& arguments) {
    const std::string command = "cd '" + folder_.path() + "' && node '" + kWeb + script + "' " +
                                arguments + " > out.txt 2> err.txt";
    if (std::system(command.c_str()) == 0) return "";
    return "failed: " + *read_file(folder_.path() + "out.txt") +
           *read_file(folder_.path() + "err.txt");
  }
  void put(const std::string& name, const std::string& bytes) {
    ASSERT_TRUE(write_file(folder_.path() + name, bytes, true).ok());
  }
  // Loads and shows a file, and compares the places of all joints at `frame` of clip `which` with
  // ours.
  void expect_seen_alike(const std::string& bytes, int which, int frame) {
    put("seen.glb", bytes);
    const auto file = must_read(bytes);
    const Clip& clip = file->clip(which);
    const std::string name = file->clip_names()[static_cast<size_t>(which)];
    ASSERT_EQ(run("render.mjs", "seen.glb seen.png " + std::to_string(frame * clip.frame_time) +
                                    " '" + name + "'"),
              "");
    const Json seen = Json::parse(*read_file(folder_.path() + "out.txt"));
    EXPECT_EQ(seen["clips"].get<std::vector<std::string>>(), file->clip_names());
    const std::vector<Vec3> positions = world_positions(clip, frame);
    for (size_t j = 0; j < clip.joints(); ++j) {
      const Json& shown = seen["places"][clip.skeleton.joints[j].name];
      const Vec3 at = {shown[0].get<float>(), shown[1].get<float>(), shown[2].get<float>()};
      // The time is given with six decimals; nothing moves faster than 10 m/s.
      EXPECT_LT(length(at - positions[j]), 2e-5f) << clip.skeleton.joints[j].name;
    }
    // A picture of one colour is a tenth of that.
    EXPECT_GT(std::filesystem::file_size(folder_.path() + "seen.png"), 5000u);
  }

  test::TemporaryFolder folder_;
};

// The character's file with both clips changed, beside the old ones and in their place.
std::string changed(const MotionFile& file, EditMode mode) {
  std::vector<Clip> clips = {file.clip(0), file.clip(1)};
  std::vector<std::vector<double>> frames;
  for (Clip& clip : clips) {
    const size_t spine = joint_named(clip, "Spine");
    for (int f = 0; f < clip.frames; ++f) {
      clip.pose(f).rotations[spine] = axis_angle(Vec3d{1, 0, 0}, 0.01 * f).as<float>();
    }
    frames.push_back(same_frames(clip.frames));
  }
  // The second one in half the time.
  clips[1].resize(31);
  frames[1].resize(31);
  for (size_t f = 0; f < 31; ++f) frames[1][f] = 2.0 * static_cast<double>(f);
  const ClipEdit edits[] = {{0, &clips[0], frames[0], "Walk bent"},
                            {1, &clips[1], frames[1], "Wave bent"}};
  return file.encode(edits, mode);
}

TEST_F(GltfPrograms, the_khronos_validator_finds_no_error) {
  if (const std::string what = missing(false); !what.empty()) GTEST_SKIP() << what;
  using enum test::CharacterOptions::Vrm;
  std::string names;
  const auto add = [&](const std::string& name, const std::string& bytes) {
    put(name, bytes);
    names += " " + name;
  };
  for (const auto vrm : {none, vrm0, vrm1}) {
    const test::GltfParts parts = test::character({.vrm = vrm, .centimetres = vrm == vrm0});
    const std::string number = std::to_string(static_cast<int>(vrm));
    const auto file = must_read(parts);
    add("before" + number + ".glb", test::to_glb(parts));
    add("beside" + number + ".glb", changed(*file, EditMode::add_beside));
    add("replaced" + number + ".glb", changed(*file, EditMode::replace));
    add("text" + number + ".gltf",
        changed(*must_read(test::to_gltf_text(parts)), EditMode::add_beside));
  }
  // Keys before 0 are an error, and what is made of them is none.
  test::GltfParts early = test::character();
  const size_t times = early.add_bounded(test::key_times(31, 30, -0.5f), "SCALAR", 1);
  early.json["animations"][0]["samplers"][0]["input"] = times;
  put("early.glb", test::to_glb(early));
  EXPECT_NE(run("validate.mjs", "early.glb"), "");
  const auto mended = must_read(early);
  add("whole.glb", mended->encode({}, EditMode::replace));
  for (const EditMode mode : {EditMode::add_beside, EditMode::replace}) {
    add("mended" + std::to_string(static_cast<int>(mode)) + ".glb", changed(*mended, mode));
  }
  for (const char* fixture : kBvhFixtures) {
    const auto bvh = must_parse(read_fixture(fixture));
    add(std::string(fixture) + ".glb", format_glb(bvh->clip(), "a walk", 0.01, {}));
  }
  const Clip walk = test::walking_clip(10);
  const SkinnedBody body = make_rig_body(*Rig::create(walk), walk.pose(0));
  add("body.glb", format_glb(walk, "a walk", 1, {}, &body));
  EXPECT_EQ(run("validate.mjs", names), "");
}

TEST_F(GltfPrograms, the_validator_would_find_an_error) {
  if (const std::string what = missing(false); !what.empty()) GTEST_SKIP() << what;
  test::GltfParts parts = test::small_gltf();
  parts.json["accessors"][0]["max"][0] = 7;
  put("bad.glb", test::to_glb(parts));
  EXPECT_NE(run("validate.mjs", "bad.glb"), "");
}

TEST_F(GltfPrograms, three_js_shows_the_motion_that_we_read_and_wrote) {
  if (const std::string what = missing(true); !what.empty()) GTEST_SKIP() << what;
  expect_seen_alike(test::to_glb(test::character()), 0, 10);
  // Clip 3 is the second one, changed in pose and time.
  const auto file = must_read(test::character({.centimetres = true}));
  expect_seen_alike(changed(*file, EditMode::add_beside), 3, 20);
  // Sticks, for a clip from elsewhere.
  expect_seen_alike(format_glb(file->clip(), "sticks", 1, {}), 0, 10);
}

TEST_F(GltfPrograms, three_js_shows_a_body_on_joints_that_came_alone) {
  if (const std::string what = missing(true); !what.empty()) GTEST_SKIP() << what;
  const Clip walk = test::walking_clip(20);
  GltfParts parts = test::glb_parts(format_glb(walk, "walk", 1, {}));
  parts.json.erase("skins");
  parts.json.erase("meshes");
  parts.json["nodes"].erase(parts.json["nodes"].size() - 1);  // The mesh's.
  parts.json["scenes"][0]["nodes"] = {0};
  const Result<std::string> whole =
      whole_character(test::to_glb(parts), "walk.glb", true, [](const MotionFile& file) {
        return std::optional(make_rig_body(*Rig::create(file.clip()), file.clip().pose(0)));
      });
  ASSERT_TRUE(whole.ok()) << whole.error().message;
  expect_seen_alike(*whole, 0, 10);
  // A person's size, not a heap at the origin.
  const Json seen = Json::parse(*read_file(folder_.path() + "out.txt"));
  const float height = seen["box"][1][1].get<float>() - seen["box"][0][1].get<float>();
  EXPECT_GT(height, 1.4f);
  EXPECT_LT(height, 2.2f);
  EXPECT_EQ(run("validate.mjs", "seen.glb"), "");
}

}  // namespace
}  // namespace panache
