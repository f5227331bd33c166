// panache convert: motion files from one format to another.

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "cli/same_positions.h"
#include "clip/make_character.h"

namespace panache::test {
namespace {

// Six decimals of a degree and of a metre in BVH add up to less than this along a body. Metres.
constexpr float kNear = 2e-5f;

class Convert : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_walk("walk.bvh");
    write("hero.glb", to_glb(character()));
  }
};

TEST_F(Convert, the_same_format_is_the_very_file) {
  write("hero.vrm", read("hero.glb"));
  for (const std::string name : {"walk.bvh", "hero.glb", "hero.vrm"}) {
    must_quietly({"convert", name, "-o", "out/" + name});
    EXPECT_TRUE(read("out/" + name) == read(name)) << name;
  }
  must_quietly("convert hero.vrm -o out/vrm.glb");
  EXPECT_TRUE(read("out/vrm.glb") == read("hero.glb"));
}

TEST_F(Convert, bvh_becomes_glb_in_metres_with_y_up) {
  // The walk in centimetres with Z up.
  Clip walk = walking_clip(40);
  const Quat turn = {std::sqrt(0.5f), 0, 0, std::sqrt(0.5f)};
  for (Joint& joint : walk.skeleton.joints) joint.offset *= 100;
  for (Vec3& t : walk.translations) t *= 100;
  for (int f = 0; f < walk.frames; ++f) {
    walk.pose(f).translations[0] = rotate(turn, walk.pose(f).translations[0]);
    walk.pose(f).rotations[0] = turn * walk.pose(f).rotations[0];
  }
  write("z.bvh", format_bvh(walk));
  must_quietly("convert z.bvh -o z.glb --scale 0.01");
  const auto file = open("z.glb");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->clip_names(), std::vector<std::string>{"z"});
  expect_same_positions(walking_clip(40), file->clip(), kNear);
  // The legs tell the unit as well.
  must_quietly("convert z.bvh -o found.glb");
  expect_same_positions(walking_clip(40), open("found.glb")->clip(), 0.01f);
}

TEST_F(Convert, glb_becomes_bvh_with_every_joint_in_its_place_at_rest_too) {
  const auto glb = open("hero.glb");
  for (const int which : {0, 1}) {
    const std::string name = glb->clip_names()[static_cast<size_t>(which)];
    SCOPED_TRACE(name);
    must_quietly({"convert", "hero.glb", "--clip", name, "-o", name + ".bvh"});
    const auto bvh = open(name + ".bvh");
    ASSERT_TRUE(bvh);
    expect_same_positions(glb->clip(which), bvh->clip(), kNear);
    expect_same_positions(rest_clip(glb->clip().skeleton), rest_clip(bvh->clip().skeleton), kNear);
  }
}

TEST_F(Convert, gltf_takes_along_what_it_points_to) {
  const GltfParts parts = character();
  write("in/hero.gltf", to_gltf_text(parts, "hero.bin"));
  write("in/hero.bin", parts.bin);
  must_quietly("convert in/hero.gltf -o out/hero.gltf");
  must_quietly("convert in/hero.gltf -o out/hero.glb");
  for (const std::string name : {"out/hero.gltf", "out/hero.glb"}) {
    const auto before = open("hero.glb"), after = open(name);
    ASSERT_TRUE(before && after);
    EXPECT_EQ(after->clip_names(), before->clip_names());
    expect_same_positions(before->clip(), after->clip(), 0);
  }
  const GltfParts glb = glb_parts(read("out/hero.glb"));
  EXPECT_EQ(glb.json["meshes"], parts.json["meshes"]);
  EXPECT_TRUE(glb.bin == parts.bin);
}

TEST_F(Convert, gltf_with_several_buffers_becomes_glb_with_one) {
  GltfParts parts = character();
  // The last view's bytes go into a buffer of their own.
  Json& view = parts.json["bufferViews"].back();
  const std::string bytes = parts.bin.substr(view.value("byteOffset", 0), view["byteLength"]);
  view["buffer"] = 1;
  view["byteOffset"] = 4;
  Json whole = Json::parse(to_gltf_text(parts));
  whole["buffers"].push_back(
      {{"byteLength", bytes.size() + 4},
       {"uri", "data:application/octet-stream;base64," + to_base64("pad!" + bytes)}});
  write("two.gltf", whole.dump());
  must_quietly("convert two.gltf -o two.glb");
  const GltfParts glb = glb_parts(read("two.glb"));
  ASSERT_EQ(glb.json["buffers"].size(), 1u);
  const Json& moved = glb.json["bufferViews"].back();
  EXPECT_EQ(moved["buffer"], 0);
  EXPECT_TRUE(glb.bin.substr(moved["byteOffset"], moved["byteLength"]) == bytes);
}

TEST_F(Convert, one_of_several_motions_must_be_named) {
  expect_rejected("convert hero.glb -o out.bvh", 1,
                  "hero.glb: holds 2 motions ('Walk', 'Wave') and out.bvh takes one; --clip NAME "
                  "picks it");
  expect_rejected("convert hero.glb --clip Run -o out.bvh", 1,
                  "hero.glb: holds no motion 'Run'; expected one of 'Walk', 'Wave'");
  expect_rejected(
      "convert hero.glb --clip Walk -o out.glb", 1,
      "hero.glb: all its motions are written to out.glb; expected no --clip, which is for "
      "formats that hold one motion");
  expect_rejected(
      "convert walk.bvh --clip Walk -o out.glb", 1,
      "walk.bvh: holds one motion, which has no name; expected no --clip, found 'Walk'");
}

TEST_F(Convert, what_is_no_humanoid_keeps_its_units) {
  Skeleton box;
  box.joints.push_back({"Box", -1, {}, {}, true, true, {{0, 1, 0}}, ""});
  write("box.bvh",
        format_bvh({box, 1.0 / 30, 2, std::vector<Quat>(2), std::vector<Vec3>(2, {0, 0, 5})}));
  EXPECT_EQ(must("convert box.bvh -o box.glb").err,
            "panache: box.bvh: is not a humanoid, so unit and up axis cannot be inferred; taken as "
            "metres and +Y unless --scale and --up are given\n");
  expect_same_positions(open("box.bvh")->clip(), open("box.glb")->clip(), 0);
  must_quietly("convert box.bvh -o big.glb --scale 2 --up z");
  const auto big = open("big.glb");
  EXPECT_NEAR(world_positions(big->clip(), 0)[1].y, 10, 1e-5) << "twice as large and Y up";
}

TEST_F(Convert, a_folder_needs_a_format) {
  write_walk("takes/a.bvh");
  write("takes/b.glb", to_glb(small_gltf()));
  expect_rejected("convert takes -o out", 2,
                  "--output out: is a folder; expected --to with it, as in --to bvh");
  expect_rejected("convert takes -o out --to c3d", 2,
                  "--to: expected bvh, glb, vrma, fbx or npz, found 'c3d'");
  expect_rejected("convert walk.bvh -o out.glb --to bvh", 2,
                  "--to bvh: out.glb has another format");
  must_quietly("convert takes -o out --to bvh");
  EXPECT_EQ(entries("out"), (std::vector<std::string>{"a.bvh", "b.bvh"}));
  write("takes/a.glb", to_glb(small_gltf()));
  expect_rejected(
      "convert takes -o more --to bvh", 2,
      "'takes/a.bvh' and 'takes/a.glb' would both be written to more/a.bvh; expected inputs "
      "with different names");
}

TEST_F(Convert, tells_machines_what_it_did) {
  const Ran ran = must("convert hero.glb walk.bvh --to glb -o out --json");
  const auto files = nlohmann::json::parse(ran.out);
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[0]["clips"].size(), 2u);
  EXPECT_EQ(files[0]["clips"][1]["name"], "Wave");
  EXPECT_EQ(files[1]["frames"], 40);
  EXPECT_EQ(files[1]["mapping"]["likely_unit"], "metres");
}

}  // namespace
}  // namespace panache::test
