// panache stylize on files that hold more than one motion, and from one format to another.

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "cli/same_positions.h"
#include "clip/gltf.h"
#include "clip/make_character.h"
#include "rig/made_up.h"

namespace panache::test {
namespace {

class StylizeGltf : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write("hero.glb", to_glb(character()));
    write_walk("walk.bvh");
  }
  Ran stylize(const Words& arguments) { return run("stylize" + arguments); }
  std::unique_ptr<MotionFile> styled(const Words& arguments) {
    must("stylize --force" + arguments);
    return open(*(std::find(arguments.begin(), arguments.end(), "-o") + 1));
  }
  using Names = std::vector<std::string>;
};

TEST_F(StylizeGltf, a_name_tells_styles_and_strengths) {
  write("table.csv", "seconds,sad\n0,0\n0.5,1\n");
  const auto file = styled(
      "hero.glb --clip Walk --style old=0.5 --style proud=0..1 --strengths table.csv -o out.glb");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->clip_names(), (Names{"Walk (old 0.5, proud 0..1, sad varies)", "Walk", "Wave"}));
}

TEST_F(StylizeGltf, new_motions_take_the_place_of_the_old_when_asked) {
  const auto before = read_motion(path("hero.glb"));
  const auto file = styled("hero.glb --replace --clip Wave --style old=1 -o out.glb");
  ASSERT_TRUE(before.ok() && file);
  EXPECT_EQ(file->clip_names(), (Names{"Walk", "Wave"}));
  expect_same_positions((*before)->clip(0), file->clip(0), 0);
  EXPECT_FALSE((*before)->clip(1).rotations == file->clip(1).rotations);
}

TEST_F(StylizeGltf, one_motion_goes_into_a_bvh) {
  const auto glb = styled("hero.glb --clip Walk --style old=1 -o out.glb");
  const auto bvh = styled("hero.glb --clip Walk --style old=1 -o out.bvh");
  ASSERT_TRUE(glb && bvh);
  expect_same_positions(glb->clip(0), bvh->clip(), 2e-5f);
}

TEST_F(StylizeGltf, a_bvh_goes_into_a_glb) {
  const auto bvh = styled("walk.bvh --style old=1 -o out.bvh");
  const auto glb = styled("walk.bvh --style old=1 -o out.glb");
  ASSERT_TRUE(bvh && glb);
  EXPECT_EQ(glb->clip_names(), Names{"walk (old 1)"});
  // The body's legs are those of the canonical one, whose unit is the metre, to rounding.
  expect_same_positions(bvh->clip(), glb->clip(), 1e-3f);
}

// A beast without telling names, one of whose motions could be a person's.
TEST_F(StylizeGltf, a_file_that_one_motion_shows_to_be_no_humanoid_is_rejected_as_a_whole) {
  Clip walk = anonymous(walking_clip(20), 3).clip;
  write("beast.glb", format_glb(walk, "Run", 1, {}));
  Clip bark = walk;
  for (size_t i = 0; i < bark.translations.size(); ++i) {
    // All that hung below its parents folds up over them.
    bark.translations[i].y = std::abs(bark.translations[i].y);
    bark.translations[i].x = 0;
  }
  const auto file = read_motion(path("beast.glb"));
  ASSERT_TRUE(file.ok());
  // Below the node that the file has above the joints.
  Clip beside = (*file)->rest();
  const size_t above = beside.joints() - bark.joints();
  beside.resize(bark.frames);
  for (int f = 0; f < bark.frames; ++f) {
    for (size_t j = 0; j < beside.joints(); ++j) {
      beside.pose(f).rotations[j] = j < above ? Quat{} : bark.pose(f).rotations[j - above];
      beside.pose(f).translations[j] = j < above ? Vec3{} : bark.pose(f).translations[j - above];
    }
  }
  const ClipEdit edit = {kNewClip, &beside, {}, "Bark"};
  write("beast.glb", (*file)->encode({&edit, 1}, EditMode::add_beside));
  const Ran ran = stylize("beast.glb --style old=1 -o out.glb");
  EXPECT_EQ(ran.exit, 1) << ran.err;
  EXPECT_TRUE(begins(ran.err, "panache: beast.glb: Bark: no humanoid found: "));
  EXPECT_TRUE(ran.err.ends_with("; so its other motions are not restyled either\n")) << ran.err;
  EXPECT_FALSE(exists("out.glb"));
  EXPECT_EQ(stylize("beast.glb --clip Run --style old=1 -o out.glb").exit, 0);
}

TEST_F(StylizeGltf, a_motion_that_cannot_be_restyled_stays_with_a_note) {
  GltfParts parts = character();
  const size_t times = parts.add_bounded({0.0f}, "SCALAR", 1);
  const size_t nowhere = parts.add(std::vector<float>{0, 0, 0}, "VEC3", 3);
  for (size_t node = 0; node < parts.json["nodes"].size(); ++node) {
    const std::string name = parts.json["nodes"][node].value("name", "");
    if (name.ends_with("Leg") || name.ends_with("Foot")) {
      parts.add_channel(1, node, "translation", "LINEAR", times, nowhere);
    }
  }
  write("legless.glb", to_glb(parts));
  const std::string message = "panache: legless.glb: Wave: the legs of the humanoid have no length";
  const Ran both = stylize("legless.glb --style old=1 -o out.glb");
  EXPECT_EQ(both.exit, 0);
  EXPECT_EQ(both.err, message + "; this motion is left unchanged\n");
  const auto file = read_motion(path("out.glb"));
  ASSERT_TRUE(file.ok());
  EXPECT_EQ((*file)->clip_names(), (Names{"Walk (old 1)", "Walk", "Wave"}));
  const Ran one = stylize("legless.glb --clip Wave --style old=1 -o no.glb");
  EXPECT_EQ(one.exit, 1);
  EXPECT_EQ(one.err, message + "\n");
  EXPECT_FALSE(exists("no.glb"));
}

TEST_F(StylizeGltf, a_skeleton_without_motion_is_rejected) {
  GltfParts parts = character();
  parts.json.erase("animations");
  write("still.glb", to_glb(parts));
  const Ran ran = stylize("still.glb --style old=1 -o out.glb");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(ran.err,
            "panache: still.glb: holds a skeleton and no motion; expected a file with an "
            "animation\n");
  const Ran info = must("info still.glb");
  EXPECT_TRUE(holds(info.out, "  motion  none: the following describes the rest pose\n"));
}

TEST_F(StylizeGltf, info_lists_the_motions) {
  const Ran ran = must("info hero.glb --clip Wave");
  EXPECT_TRUE(holds(ran.out, "  motion  Walk  31 frames at 30 a second: 1.03 s, a loop\n"));
  EXPECT_TRUE(holds(ran.out, "\n  motion  Wave  "));
  EXPECT_TRUE(holds(ran.out, " (shown below)\n"));
}

TEST_F(StylizeGltf, the_machine_hears_of_every_motion) {
  const Ran ran = stylize("hero.glb --style old=1 --json -o out.glb");
  EXPECT_EQ(ran.exit, 0) << ran.err;
  const auto file = nlohmann::json::parse(ran.out)[0];
  ASSERT_EQ(file["clips"].size(), 2u);
  EXPECT_EQ(file["clips"][1]["name"], "Wave");
  EXPECT_EQ(file["clips"][1]["result"], "Wave (old 1)");
  EXPECT_EQ(file["frames"],
            file["clips"][0]["frames_out"].get<int>() + file["clips"][1]["frames_out"].get<int>());
}

}  // namespace
}  // namespace panache::test
