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
  std::unique_ptr<MotionFile> open(const std::string& name) const {
    auto file = read_motion(path(name));
    EXPECT_TRUE(file.ok()) << file.error().message;
    return file ? *std::move(file) : nullptr;
  }
  void expect_rejected(std::vector<std::string> arguments, int exit, const std::string& message) {
    const Ran ran = run(arguments);
    EXPECT_EQ(ran.err, "panache: " + message + "\n");
    EXPECT_EQ(ran.exit, exit);
    EXPECT_FALSE(exists("out.glb"));
  }
  using Names = std::vector<std::string>;
};

TEST_F(RetargetVerb, a_motion_takes_the_place_of_the_characters_with_its_own_rate) {
  write("slow.bvh", format_bvh(walking_clip(30, 24)));
  const Ran ran = run({"retarget", "slow.bvh", "--onto", "hero.glb", "-o", "out.glb"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.out.find("\n  new: 'slow'; the character's own ('Walk', 'Wave') are dropped; "
                         "--first keeps them\n"),
            std::string::npos)
      << ran.out;
  const auto file = open("out.glb");
  ASSERT_TRUE(file);
  EXPECT_EQ(file->clip_names(), (Names{"slow"}));
  EXPECT_EQ(file->clip(0).frames, 30);
  EXPECT_NEAR(file->clip(0).frame_time, 1.0 / 24, 1e-6);
  EXPECT_EQ(glb_parts(read("out.glb")).json["meshes"], character().json["meshes"]);
}

TEST_F(RetargetVerb, motions_that_stay_keep_their_bits) {
  ASSERT_EQ(run({"retarget", "walk.bvh", "--onto", "hero.glb", "--last", "-o", "last.glb"}).exit,
            0);
  const auto file = open("last.glb"), before = open("hero.glb");
  EXPECT_EQ(file->clip_names(), (Names{"Walk", "Wave", "walk"}));
  EXPECT_EQ(file->clip(0).rotations, before->clip(0).rotations);
}

TEST_F(RetargetVerb, motions_go_first_or_alone_when_asked) {
  ASSERT_EQ(run({"retarget", "walk.bvh", "--onto", "hero.glb", "--first", "-o", "first.glb"}).exit,
            0);
  EXPECT_EQ(open("first.glb")->clip_names(), (Names{"walk", "Walk", "Wave"}));
  ASSERT_EQ(run({"retarget", "walk.bvh", "--onto", "hero.glb", "--replace", "-o", "one.glb"}).exit,
            0);
  EXPECT_EQ(open("one.glb")->clip_names(), (Names{"walk"}));
}

TEST_F(RetargetVerb, a_name_that_is_taken_gets_a_number) {
  ASSERT_EQ(run({"retarget", "hero.glb", "--onto", "hero.glb", "--last", "-o", "out.glb"}).exit, 0);
  EXPECT_EQ(open("out.glb")->clip_names(), (Names{"Walk", "Wave", "Walk (2)", "Wave (2)"}));
}

TEST_F(RetargetVerb, a_bvh_character_keeps_its_joints) {
  const Ran ran =
      run({"retarget", "hero.glb", "--clip", "Walk", "--onto", "walk.bvh", "-o", "out.bvh"});
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto file = open("out.bvh"), onto = open("walk.bvh"), from = open("hero.glb");
  ASSERT_EQ(file->clip().joints(), onto->clip().joints());
  for (size_t j = 0; j < file->clip().joints(); ++j) {
    EXPECT_EQ(file->clip().skeleton.joints[j].name, onto->clip().skeleton.joints[j].name);
    EXPECT_LT(
        length(file->clip().skeleton.joints[j].offset - onto->clip().skeleton.joints[j].offset),
        1e-5f);
  }
  EXPECT_EQ(file->clip().frames, from->clip(0).frames);
  EXPECT_NEAR(file->clip().frame_time, from->clip(0).frame_time, 1e-6);
}

TEST_F(RetargetVerb, strength_0_onto_a_character_is_retarget_alone_bit_for_bit) {
  write("other.bvh", format_bvh(walking_clip(20)));
  ASSERT_EQ(run({"retarget", "walk.bvh", "--onto", "other.bvh", "-o", "alone.bvh"}).exit, 0);
  ASSERT_EQ(
      run({"stylize", "walk.bvh", "--onto", "other.bvh", "--style", "old=0", "-o", "styled.bvh"})
          .exit,
      0);
  EXPECT_TRUE(read("alone.bvh") == read("styled.bvh"));
  ASSERT_EQ(run({"retarget", "walk.bvh", "--onto", "hero.glb", "-o", "alone.glb"}).exit, 0);
  ASSERT_EQ(
      run({"stylize", "walk.bvh", "--onto", "hero.glb", "--style", "old=0", "-o", "styled.glb"})
          .exit,
      0);
  const auto alone = open("alone.glb"), styled = open("styled.glb");
  EXPECT_EQ(styled->clip_names().back(), "walk (old 0)");
  EXPECT_EQ(alone->clip(0).rotations, styled->clip(0).rotations);
  EXPECT_EQ(alone->clip(0).translations, styled->clip(0).translations);
}

TEST_F(RetargetVerb, a_style_onto_a_character_is_the_style_of_the_retargeted_motion) {
  ASSERT_EQ(run({"retarget", "walk.bvh", "--onto", "walk.bvh", "-o", "two.bvh"}).exit, 0);
  ASSERT_EQ(
      run({"stylize", "walk.bvh", "--onto", "walk.bvh", "--style", "old=1", "-o", "a.bvh"}).exit,
      0);
  EXPECT_FALSE(read("a.bvh") == read("two.bvh"));
}

TEST_F(RetargetVerb, convert_onto_is_retarget) {
  ASSERT_EQ(run({"retarget", "walk.bvh", "--onto", "hero.glb", "-o", "a.glb"}).exit, 0);
  ASSERT_EQ(run({"convert", "walk.bvh", "--onto", "hero.glb", "-o", "b.glb"}).exit, 0);
  EXPECT_TRUE(read("a.glb") == read("b.glb"));
}

TEST_F(RetargetVerb, many_motions_go_into_files_of_the_characters_format) {
  write_walk("in/a.bvh");
  write_walk("in/b.bvh");
  ASSERT_EQ(run({"retarget", "in", "--onto", "hero.glb", "-o", "many"}).exit, 0);
  EXPECT_EQ(entries("many"), (Names{"a.glb", "b.glb"}));
  for (const std::string verb : {"retarget", "convert"}) {
    ASSERT_EQ(run({verb, "in", "--onto", "hero.glb", "--to", "bvh", "-o", verb}).exit, 0);
    EXPECT_EQ(entries(verb), (Names{"a.bvh", "b.bvh"}));
  }
}

TEST_F(RetargetVerb, bad_wishes_are_rejected) {
  expect_rejected(
      {"retarget", "walk.bvh", "--onto", "hero.glb", "-o", "out.txt"}, 2,
      "out.txt: expected a name that ends in .bvh, .glb, .vrma, .fbx or .npz, or a folder (with a "
      "'/' at its end)");
  expect_rejected({"retarget", "walk.bvh", "--onto", "none.glb", "-o", "out.glb"}, 1,
                  "none.glb: cannot be read: No such file or directory");
  expect_rejected(
      {"retarget", "hero.glb", "--onto", "walk.bvh", "-o", "out.bvh"}, 1,
      "hero.glb: the animation has keys for upper joints of the body alone, to lie over "
      "another: joints without keys get none\npanache: out.bvh: takes one motion, found 2 "
      "motions; --clip NAME picks one");
  expect_rejected({"retarget", "walk.bvh", "--onto", "hero.glb", "--to", "amc", "-o", "out/"}, 2,
                  "--to: expected bvh, glb, vrma, fbx or npz, found 'amc'");
  write("dog.bvh",
        "HIERARCHY\nROOT a\n{\nOFFSET 0 0 0\nCHANNELS 3 Zrotation Xrotation Yrotation\nEnd Site\n"
        "{\nOFFSET 0 1 0\n}\n}\nMOTION\nFrames: 1\nFrame Time: 0.1\n0 0 0\n");
  const Ran ran = run({"retarget", "walk.bvh", "--onto", "dog.bvh", "-o", "out.bvh"});
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(ran.err.starts_with("panache: dog.bvh: no humanoid found")) << ran.err;
}

}  // namespace
}  // namespace panache::test
