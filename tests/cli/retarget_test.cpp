// panache retarget, and --onto of stylize and convert.

#include "cli/program.h"
#include "clip/make_character.h"
#include "clip/motion_file.h"

namespace panache::test {
namespace {

class RetargetVerb : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_walk("walk.bvh", 40);
    write("hero.glb", to_glb(character()));
  }
  using Names = std::vector<std::string>;
};

TEST_F(RetargetVerb, a_motion_takes_the_place_of_the_characters_with_its_own_rate) {
  write("slow.bvh", format_bvh(walking_clip(30, 24)));
  const Ran ran = must("retarget slow.bvh --onto hero.glb -o out.glb");
  EXPECT_TRUE(holds(ran.out,
                    "\n  new: 'slow'; the character's own ('Walk', 'Wave') are dropped; "
                    "--first keeps them\n"));
  const auto file = open("out.glb");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->clip_names(), (Names{"slow"}));
  EXPECT_EQ(file->clip(0).frames, 30);
  EXPECT_NEAR(file->clip(0).frame_time, 1.0 / 24, 1e-6);
  EXPECT_EQ(glb_parts(read("out.glb")).json["meshes"], character().json["meshes"]);
}

TEST_F(RetargetVerb, motions_stay_or_go_as_asked_and_those_that_stay_keep_their_bits) {
  const std::pair<const char*, Names> cases[] = {
      {"walk.bvh --last", {"Walk", "Wave", "walk"}},
      {"walk.bvh --first", {"walk", "Walk", "Wave"}},
      {"walk.bvh --replace", {"walk"}},
      {"hero.glb --last", {"Walk", "Wave", "Walk (2)", "Wave (2)"}},  // Names that are taken.
  };
  for (const auto& [arguments, names] : cases) {
    must(Words("retarget --onto hero.glb --force -o out.glb") + arguments);
    EXPECT_EQ(open("out.glb")->clip_names(), names) << arguments;
  }
  EXPECT_EQ(open("out.glb")->clip(0).rotations, open("hero.glb")->clip(0).rotations);
  must("stylize walk.bvh --onto hero.glb --style old=1 --first -o old.glb");
  EXPECT_EQ(open("old.glb")->clip_names(), (Names{"walk (old 1)", "Walk", "Wave"}));
}

TEST_F(RetargetVerb, a_bvh_character_keeps_its_joints) {
  must("retarget hero.glb --clip Walk --onto walk.bvh -o out.bvh");
  const auto file = open("out.bvh"), onto = open("walk.bvh"), from = open("hero.glb");
  ASSERT_EQ(file->clip().joints(), onto->clip().joints());
  for (size_t j = 0; j < file->clip().joints(); ++j) {
    const Joint &a = file->clip().skeleton.joints[j], &b = onto->clip().skeleton.joints[j];
    EXPECT_EQ(a.name, b.name);
    EXPECT_LT(length(a.offset - b.offset), 1e-5f);
  }
  EXPECT_EQ(file->clip().frames, from->clip(0).frames);
  EXPECT_NEAR(file->clip().frame_time, from->clip(0).frame_time, 1e-6);
}

TEST_F(RetargetVerb, strength_0_onto_a_character_is_retarget_alone_bit_for_bit) {
  write("other.bvh", format_bvh(walking_clip(20)));
  must("retarget walk.bvh --onto other.bvh -o alone.bvh");
  must("stylize walk.bvh --onto other.bvh --style old=0 -o styled.bvh");
  EXPECT_TRUE(read("alone.bvh") == read("styled.bvh"));
  must("retarget walk.bvh --onto hero.glb -o alone.glb");
  must("stylize walk.bvh --onto hero.glb --style old=0 -o styled.glb");
  const auto alone = open("alone.glb"), styled = open("styled.glb");
  EXPECT_EQ(styled->clip_names().back(), "walk (old 0)");
  EXPECT_EQ(alone->clip(0).rotations, styled->clip(0).rotations);
  EXPECT_EQ(alone->clip(0).translations, styled->clip(0).translations);
}

TEST_F(RetargetVerb, a_style_onto_a_character_is_the_style_of_the_retargeted_motion) {
  must("retarget walk.bvh --onto walk.bvh -o two.bvh");
  must("stylize walk.bvh --onto walk.bvh --style old=1 -o a.bvh");
  EXPECT_FALSE(read("a.bvh") == read("two.bvh"));
}

TEST_F(RetargetVerb, convert_onto_is_retarget) {
  must("retarget walk.bvh --onto hero.glb -o a.glb");
  must("convert walk.bvh --onto hero.glb -o b.glb");
  EXPECT_TRUE(read("a.glb") == read("b.glb"));
}

TEST_F(RetargetVerb, many_motions_go_into_files_of_the_characters_format) {
  write_walk("in/a.bvh");
  write_walk("in/b.bvh");
  must("retarget in --onto hero.glb -o many");
  EXPECT_EQ(entries("many"), (Names{"a.glb", "b.glb"}));
  for (const std::string verb : {"retarget", "convert"}) {
    must({verb, "in", "--onto", "hero.glb", "--to", "bvh", "-o", verb});
    EXPECT_EQ(entries(verb), (Names{"a.bvh", "b.bvh"}));
  }
}

TEST_F(RetargetVerb, bad_wishes_are_rejected) {
  expect_rejected(
      "retarget walk.bvh --onto hero.glb -o out.txt", 2,
      "out.txt: expected a name that ends in .bvh, .glb, .vrma, .fbx or .npz, or a folder (with a "
      "'/' at its end)");
  expect_rejected("retarget walk.bvh --onto none.glb -o out.glb", 1,
                  "none.glb: cannot be read: No such file or directory");
  expect_rejected(
      "retarget hero.glb --onto walk.bvh -o out.bvh", 1,
      "hero.glb: the animation has keys for upper joints of the body alone, to lie over "
      "another: joints without keys get none\npanache: out.bvh: takes one motion, found 2 "
      "motions; --clip NAME picks one");
  expect_rejected("retarget walk.bvh --onto hero.glb --to amc -o out/", 2,
                  "--to: expected bvh, glb, vrma, fbx or npz, found 'amc'");
  write("dog.bvh",
        "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n"
        "{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0\n");
  const Ran ran = run("retarget walk.bvh --onto dog.bvh -o out.bvh");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(begins(ran.err, "panache: dog.bvh: no humanoid found"));
}

}  // namespace
}  // namespace panache::test
