// The sides of styles: --side of stylize and live, and what styles and stylize say of them.

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "known_recipes.h"

namespace panache::test {
namespace {

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
  Ran stylize(std::vector<std::string> more, const std::string& output = "out.bvh") {
    std::vector<std::string> arguments = {"stylize", "walk.bvh", "--force", "-o", output};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
  }
  std::string styled(std::vector<std::string> more) {
    const Ran ran = stylize(std::move(more));
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return read("out.bvh");
  }
};

TEST_F(SideOption, takes_the_captured_or_the_other_side_by_any_of_its_names) {
  const std::string captured = styled({"--style", "old=1"});
  EXPECT_TRUE(styled({"--style", "old=1", "--side", "old=right"}) == captured);
  EXPECT_TRUE(styled({"--style", "old=1", "--side", "OLD=captured"}) == captured);
  EXPECT_TRUE(styled({"--style", "old=1", "--side", "old=1"}) == captured);
  const std::string mirrored = styled({"--style", "old=1", "--side", "old=left"});
  EXPECT_TRUE(mirrored != captured);
  EXPECT_TRUE(styled({"--style", "old=1", "--side", "old=mirrored"}) == mirrored);
  EXPECT_TRUE(styled({"--style", "old=1", "--side", "old=-1"}) == mirrored);
  const std::string between = styled({"--style", "old=1", "--side", "old=0.5"});
  EXPECT_TRUE(between != captured && between != mirrored);
  // Another style's side is its own.
  EXPECT_TRUE(styled({"--style", "old=1", "--style", "sad=0", "--side", "sad=right"}) == captured);
}

TEST_F(SideOption, names_result_and_motion) {
  ASSERT_EQ(run({"stylize", "walk.bvh", "--style", "old=1", "--side", "old=left"}).exit, 0);
  EXPECT_TRUE(exists("walk-old-left.bvh"));
  ASSERT_EQ(run({"stylize", "walk.bvh", "--style", "old=1", "--side", "old=-0.5"}).exit, 0);
  EXPECT_TRUE(exists("walk-old-side-0.5.bvh"));
  const Ran ran = stylize({"--style", "old=1", "--side", "old=left", "--json"}, "out.glb");
  ASSERT_EQ(ran.exit, 0) << ran.err;
  const auto clip = nlohmann::json::parse(ran.out)[0]["clips"][0];
  EXPECT_EQ(clip["styles"][0]["side"], -1.0);
  EXPECT_EQ(clip["result"], "walk (old 1 mirrored)");
}

TEST_F(SideOption, that_makes_no_sense_is_rejected_with_the_cure) {
  const auto message = [&](const std::string& side) {
    const Ran ran = run({"stylize", "walk.bvh", "-o", "none.bvh", "--style", "old=1", "--style",
                         "proud=1", "--side", side});
    EXPECT_EQ(ran.exit, 2);
    EXPECT_FALSE(exists("none.bvh"));
    return ran.err;
  };
  EXPECT_EQ(message("proud=left"),
            "panache: --side proud=left: the model does not say which side style 'proud' was "
            "captured on, so 'left' is unknown; expected captured, mirrored or a number from -1 to "
            "1\n");
  EXPECT_EQ(message("old=up"),
            "panache: --side old=up: unknown side 'up' of style 'old'; expected left, right, "
            "captured, mirrored or a number from -1 to 1\n");
  EXPECT_EQ(message("old=2"), "panache: --side old=2: expected a side from -1 to 1, found '2'\n");
  EXPECT_EQ(message("old"),
            "panache: --side old: expected a style and a side, as in 'old=mirrored'\n");
  EXPECT_EQ(message("sad=right"),
            "panache: --side sad=right: style 'sad' is not put on; add --style sad=1, or leave the "
            "side out\n");
  EXPECT_NE(message("olld=left").find("unknown style 'olld'"), std::string::npos);
  EXPECT_EQ(
      run({"stylize", "walk.bvh", "--style", "old=1", "--side", "old=left", "--side", "old=right"})
          .err,
      "panache: --side old=right: this style has a side already; expected each style once\n");
}

TEST_F(SideOption, of_a_recipe_without_sides_is_rejected) {
  write("model.safetensors", format_safetensors(make_model({"old"}, 1, kSmith2019)));
  for (const char* side : {"old=mirrored", "old=-1"}) {
    const Ran ran = stylize({"--style", "old=1", "--side", side});
    EXPECT_EQ(ran.exit, 2);
    EXPECT_NE(ran.err.find("recipe smith2019 have no sides"), std::string::npos) << ran.err;
  }
}

TEST_F(SideOption, is_told_by_the_lists_of_styles) {
  EXPECT_NE(run({"styles"})
                .out.find("  old    looks old\n"
                          "         side: right leg\n"
                          "  proud  looks proud\n"
                          "  sad    looks sad\n"
                          "         side: to the left\n"),
            std::string::npos)
      << run({"styles"}).out;
  const auto json = nlohmann::json::parse(run({"styles", "--json"}).out);
  EXPECT_EQ(json["styles"][0]["side"], "");
  EXPECT_EQ(json["styles"][1]["side"], "right leg");
  // A style keeps its side in a file of its own.
  ASSERT_EQ(run({"styles", "model.safetensors", "--extract", "old", "-o", "old.safetensors"}).exit,
            0);
  EXPECT_EQ(nlohmann::json::parse(run({"styles", "old.safetensors", "--json"}).out)["side"],
            "right leg");
}

}  // namespace
}  // namespace panache::test
