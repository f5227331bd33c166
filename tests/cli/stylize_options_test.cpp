// How much of a style is given, on which side, and by whom.

#include <set>

#include <nlohmann/json.hpp>

#include "base/quat.h"
#include "cli/program.h"
#include "clip/motion_format.h"
#include "known_recipes.h"
#include "make_model.h"

namespace panache::test {
namespace {

// How much of a style is given: --posture, --dynamics, --timing and --region.

class PartialStyleOptions : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_walk("walk.bvh");
  }
  std::string restyled(const Words& more) {
    must("stylize walk.bvh --style old=1 --force -o out.bvh" + more);
    return read("out.bvh");
  }
};

TEST_F(PartialStyleOptions, all_at_one_is_the_whole_style_and_less_is_not) {
  const std::string whole = restyled({});
  EXPECT_TRUE(restyled("--posture 1 --dynamics 1 --timing 1 --region legs=1 --region torso=1") ==
              whole);
  for (const char* more : {"--posture 0.5", "--dynamics 0"}) {
    EXPECT_TRUE(restyled(more) != whole) << more;
  }
}

// What is left of the other arm is tests/style/partial_style_test.cpp.
TEST_F(PartialStyleOptions, without_timing_and_an_arm_those_are_the_inputs) {
  restyled("--timing 0 --region left_arm=0");
  const auto out = open("out.bvh"), walk = open("walk.bvh");
  ASSERT_EQ(out->clip().frames, walk->clip().frames);
  // How far the rotations of a joint are from those of the input.
  const auto changed = [&](const std::string& name) {
    const Clip &a = walk->clip(), &b = out->clip();
    const auto j = static_cast<size_t>(std::ranges::find(a.skeleton.joints, name, &Joint::name) -
                                       a.skeleton.joints.begin());
    float max = 0;
    for (int f = 0; f < b.frames; ++f) {
      const Quat turn = conjugate(a.pose(f).rotations[j]) * b.pose(f).rotations[j];
      max = std::max(max, length(turn.xyz()));
    }
    return max;
  };
  for (const std::string joint : {"UpperArm", "LowerArm", "Hand"}) {
    EXPECT_LT(changed("left" + joint), 1e-5f) << joint;  // Floats, six decimals of a degree.
    EXPECT_GT(changed("right" + joint), 0.01f) << joint;
  }
}

TEST_F(PartialStyleOptions, a_wrong_region_is_rejected) {
  for (const std::string verb :
       {"stylize walk.bvh -o out.bvh --style old=1", "live --style old=1"}) {
    expect_rejected(verb + " --region tail=1", 2,
                    "--region 'tail=1': expected legs, torso, left_arm or right_arm, '=' and an "
                    "amount, such as legs=0.5");
    expect_rejected(verb + " --region legs=3", 2,
                    "--region 'legs=3': expected an amount of 0 to 2, found '3'");
    expect_rejected(verb + " --region legs=1 --region legs=0", 2, "--region legs is given twice");
    const Ran ran = run(verb + " --contacts 2");
    EXPECT_EQ(ran.exit, 2);
    EXPECT_TRUE(holds(ran.err, "--contacts"));
  }
}

// The options --person, --seed, --variety and --energy of stylize.

class PersonOption : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    TensorFile model = *parse_safetensors(read("model.safetensors"), "model");
    add_persons(model);
    write("model.safetensors", format_safetensors(model));
    write_walk("walk.bvh");
  }
  std::string styled(const Words& more) {
    must("stylize walk.bvh --force -o out.bvh" + more);
    return read("out.bvh");
  }
  std::string rejected(const Words& more) {
    const Ran ran = run("stylize walk.bvh --force -o out.bvh" + more);
    EXPECT_NE(ran.exit, 0);
    return ran.err;
  }
};

TEST_F(PersonOption, and_energy_change_the_motion_each_value_otherwise_and_neutral_ones_not) {
  const std::string walk = read("walk.bvh"), seven = styled("--person 7"),
                    old = styled("--style old=1");
  const std::pair<const char*, std::string> same[] = {{"--person 7", seven},
                                                      {"--person 7 --variety 1", seven},
                                                      {"--person 7 --variety 0", walk},
                                                      {"--style old=1 --energy 1", old}};
  for (const auto& [options, expected] : same) EXPECT_TRUE(styled(options) == expected) << options;
  std::set<std::string> all = {walk, seven, old};
  for (const char* options :
       {"--person 8", "--person mara", "--person marb", "--person 7 --style old=1",
        "--person 7 --variety 2", "--energy 0.4", "--energy 1.6"}) {
    EXPECT_TRUE(all.insert(styled(options)).second) << options;
  }
}

TEST_F(PersonOption, random_is_another_one_for_each_file_and_the_same_for_equal_seeds) {
  write_walk("a.bvh");
  write_walk("b.bvh");
  const auto people = [&](const std::string& seed) {
    const Ran ran = must({"stylize", "a.bvh", "b.bvh", "--person", "random", "--seed", seed, "-o",
                          "out", "--force", "--json"});
    std::vector<uint32_t> seeds;
    for (const auto& file : nlohmann::json::parse(ran.out)) {
      seeds.push_back(file["clips"][0]["person"]["seed"]);
    }
    return seeds;
  };
  const auto some = people("1");
  ASSERT_EQ(some.size(), 2u);
  EXPECT_NE(some[0], some[1]);
  EXPECT_TRUE(read("out/a.bvh") != read("out/b.bvh"));
  EXPECT_EQ(people("1"), some);
  EXPECT_NE(people("2"), some);
  // The seed that is reported gives the same person.
  EXPECT_TRUE(people("1") == some &&
              read("out/a.bvh") == styled({"--person", std::to_string(some[0])}));
}

TEST_F(PersonOption, that_makes_no_sense_is_rejected_with_the_cure) {
  EXPECT_TRUE(holds(rejected("--style old=1 --seed 3"), "add --person random"));
  EXPECT_TRUE(holds(rejected("--style old=1 --variety 1"), "add --person"));
  EXPECT_TRUE(holds(rejected("--person 7 --seed 3"), "expected --person random"));
  EXPECT_TRUE(holds(rejected("--person 7 --variety 3"), "--variety"));
  write("model.safetensors", format_safetensors(make_model({"old"})));
  EXPECT_TRUE(holds(rejected("--person 7"), "the model has no persons"));
}

TEST_F(PersonOption, names_the_result) {
  must("stylize walk.bvh --person 7");
  EXPECT_TRUE(exists("walk-person-7.bvh"));
  must("stylize walk.bvh --energy 0.5");
  EXPECT_TRUE(exists("walk-calm.bvh"));
}

// The sides of styles: --side of stylize and live, and what styles and stylize say of them.

class SideOption : public ProgramTest {
 protected:
  // Of angry, old, proud and sad, only two say which side was captured.
  void SetUp() override {
    ProgramTest::SetUp();
    TensorFile model = *parse_safetensors(read("model.safetensors"), "model");
    model.metadata["style_sides"] = "\nright leg\n\nto the left\n";
    write("model.safetensors", format_safetensors(model));
    write_walk("walk.bvh");
  }
  Ran stylize(const Words& more, const std::string& output = "out.bvh") {
    return run(Words("stylize walk.bvh --force -o " + output) + more);
  }
  std::string styled(const Words& more) {
    must("stylize walk.bvh --force -o out.bvh" + more);
    return read("out.bvh");
  }
};

TEST_F(SideOption, takes_the_captured_or_the_other_side_by_any_of_its_names) {
  const std::string captured = styled("--style old=1"),
                    mirrored = styled("--style old=1 --side old=left");
  EXPECT_TRUE(mirrored != captured);
  for (const char* side : {"old=right", "OLD=captured", "old=1"}) {
    EXPECT_TRUE(styled({"--style", "old=1", "--side", side}) == captured) << side;
  }
  for (const char* side : {"old=mirrored", "old=-1"}) {
    EXPECT_TRUE(styled({"--style", "old=1", "--side", side}) == mirrored) << side;
  }
  const std::string between = styled("--style old=1 --side old=0.5");
  EXPECT_TRUE(between != captured && between != mirrored);
  // Another style's side is its own.
  EXPECT_TRUE(styled("--style old=1 --style sad=0 --side sad=right") == captured);
}

TEST_F(SideOption, names_result_and_motion) {
  must("stylize walk.bvh --style old=1 --side old=left");
  EXPECT_TRUE(exists("walk-old-left.bvh"));
  must("stylize walk.bvh --style old=1 --side old=-0.5");
  EXPECT_TRUE(exists("walk-old-side-0.5.bvh"));
  const Ran ran = stylize("--style old=1 --side old=left --json", "out.glb");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto clip = nlohmann::json::parse(ran.out)[0]["clips"][0];
  EXPECT_EQ(clip["styles"][0]["side"], -1.0);
  EXPECT_EQ(clip["result"], "walk (old 1 mirrored)");
}

TEST_F(SideOption, that_makes_no_sense_is_rejected_with_the_cure) {
  const std::pair<const char*, const char*> cases[] = {
      {"proud=left",
       "the model does not say which side style 'proud' was captured on, so 'left' is unknown; "
       "expected captured, mirrored or a number from -1 to 1"},
      {"old=up",
       "unknown side 'up' of style 'old'; expected left, right, captured, mirrored or a number "
       "from -1 to 1"},
      {"old=2", "expected a side from -1 to 1, found '2'"},
      {"old", "expected a style and a side, as in 'old=mirrored'"},
      {"sad=right", "style 'sad' is not put on; add --style sad=1, or leave the side out"},
  };
  for (const auto& [side, message] : cases) {
    expect_rejected({"stylize", "walk.bvh", "-o", "none.bvh", "--style", "old=1", "--style",
                     "proud=1", "--side", side},
                    2, "--side " + std::string(side) + ": " + message);
  }
  EXPECT_TRUE(
      holds(run("stylize walk.bvh --style old=1 --side olld=left").err, "unknown style 'olld'"));
  expect_rejected("stylize walk.bvh --style old=1 --side old=left --side old=right", 2,
                  "--side old=right: this style has a side already; expected each style once");
}

TEST_F(SideOption, of_a_recipe_without_sides_is_rejected) {
  write("model.safetensors", format_safetensors(make_model({"old"}, 1, kSmith2019)));
  for (const char* side : {"old=mirrored", "old=-1"}) {
    const Ran ran = stylize({"--style", "old=1", "--side", side});
    EXPECT_EQ(ran.exit, 2);
    EXPECT_TRUE(holds(ran.err, "recipe smith2019 have no sides"));
  }
}

TEST_F(SideOption, is_told_by_the_lists_of_styles) {
  EXPECT_TRUE(holds(run("styles").out,
                    "  old    looks old\n"
                    "         side: right leg\n"
                    "  proud  looks proud\n"
                    "  sad    looks sad\n"
                    "         side: to the left\n"));
  const auto json = nlohmann::json::parse(run("styles --json").out);
  EXPECT_EQ(json["styles"][0]["side"], "");
  EXPECT_EQ(json["styles"][1]["side"], "right leg");
  // A style keeps its side in a file of its own.
  must("styles model.safetensors --extract old -o old.safetensors");
  EXPECT_EQ(nlohmann::json::parse(run("styles old.safetensors --json").out)["side"], "right leg");
}

}  // namespace
}  // namespace panache::test
