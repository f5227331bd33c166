// panache styles: styles taken out of models, put into others, removed and renamed.

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "make_model.h"
#include "net/layer.h"

namespace panache::test {
namespace {

class StylesVerb : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    TensorFile model = *parse_safetensors(read("model.safetensors"), "model");
    add_learnt(model, 0, "limping", "limp.bvh");
    write("mine.safetensors", format_safetensors(model));
  }

  std::vector<std::string> styles_of(const std::string& file) const {
    const auto model = Model::parse(read(file), file);
    EXPECT_TRUE(model.ok()) << model.error().message;
    std::vector<std::string> names;
    for (const StyleInfo& style : (*model)->styles()) names.push_back(style.name);
    return names;
  }
  // What panache-lab quantize makes of a model or style: int8.safetensors.
  void write_int8(const std::string& file) const {
    write("int8.safetensors", format_safetensors(quantize(*parse_safetensors(read(file), file))));
  }
  std::string size_of(const std::string& file) const { return std::to_string(read(file).size()); }

  // Runs `panache styles` and expects a message; no file may change, appear or vanish.
};

using Names = std::vector<std::string>;

TEST_F(StylesVerb, lists_learnt_styles_with_what_they_were_learnt_from) {
  const std::string text = run("styles mine.safetensors").out;
  EXPECT_TRUE(
      text.ends_with("\n5 styles:\n"
                     "  angry    looks angry\n"
                     "  old      looks old\n"
                     "  proud    looks proud\n"
                     "  sad      looks sad\n"
                     "  limping  looks limping\n"
                     "           learnt from limp.bvh\n"))
      << text;
  const auto model = nlohmann::json::parse(run("styles mine.safetensors --json").out);
  EXPECT_EQ(model["styles"][0]["learnt"], false);
  EXPECT_EQ(model["styles"][0]["origin"], "");
  EXPECT_EQ(model["styles"][4]["learnt"], true);
  EXPECT_EQ(model["styles"][4]["origin"], "limp.bvh");
}

TEST_F(StylesVerb, lists_styles_by_their_groups) {
  TensorFile model = *parse_safetensors(read("mine.safetensors"), "mine");
  model.metadata["style_groups"] = "moods\nages\n\nmoods\n\n";
  write("mine.safetensors", format_safetensors(model));
  const std::string text = run("styles mine.safetensors").out;
  EXPECT_TRUE(
      text.ends_with("\n5 styles:\n"
                     "\nmoods:\n"
                     "  angry    looks angry\n"
                     "  sad      looks sad\n"
                     "\nages:\n"
                     "  old      looks old\n"
                     "\nothers:\n"
                     "  proud    looks proud\n"
                     "\nlearnt:\n"
                     "  limping  looks limping\n"
                     "           learnt from limp.bvh\n"))
      << text;
  const auto json = nlohmann::json::parse(run("styles mine.safetensors --json").out);
  EXPECT_EQ(json["styles"][1]["group"], "ages");
  EXPECT_EQ(json["styles"][4]["group"], "");
  // The file of a style says it too, after the model was quantized as well.
  write_int8("mine.safetensors");
  must("styles int8.safetensors --extract old -o old.safetensors");
  EXPECT_TRUE(holds(run("styles old.safetensors").out, "\n  group        ages\n"));
  EXPECT_EQ(nlohmann::json::parse(run("styles old.safetensors --json").out)["group"], "ages");
}

TEST_F(StylesVerb, info_lists_only_the_names_of_a_model) {
  EXPECT_TRUE(holds(run("info mine.safetensors").out,
                    "\n5 styles:\n  angry, old, proud, sad, limping\n\nMetadata:\n"));
  TensorFile model = *parse_safetensors(read("mine.safetensors"), "mine");
  model.metadata["style_groups"] = "moods\nages\n\nmoods\n\n";
  write("mine.safetensors", format_safetensors(model));
  const std::string text = run("info mine.safetensors").out;
  EXPECT_TRUE(holds(text,
                    "\n5 styles:\n"
                    "  moods   angry, sad\n"
                    "  ages    old\n"
                    "  others  proud\n"
                    "  learnt  limping\n"
                    "\nMetadata:\n"));
  EXPECT_FALSE(holds(text, "style_groups"));
}

TEST_F(StylesVerb, a_learnt_style_shows_even_if_nobody_knows_from_what) {
  TensorFile model = *parse_safetensors(read("mine.safetensors"), "mine");
  model.metadata.erase("style_origins");
  model.metadata["style_descriptions"] = "";
  write("mine.safetensors", format_safetensors(model));
  const std::string text = run("styles mine.safetensors").out;
  EXPECT_TRUE(text.ends_with("\n  proud\n  sad\n  limping  learnt\n")) << text;
}

TEST_F(StylesVerb, describes_the_file_of_a_style) {
  must("styles mine.safetensors --extract limping -o limping.safetensors");
  const std::string text = run("styles limping.safetensors").out;
  EXPECT_TRUE(begins(text, "limping.safetensors\n  size         "));
  EXPECT_TRUE(
      text.ends_with("  data licence CC0\n\n1 style:\n"
                     "  limping  looks limping\n"
                     "           learnt from limp.bvh\n"))
      << text;
  const auto style = nlohmann::json::parse(run("styles limping.safetensors --json").out);
  EXPECT_EQ(style["style_file"], "limping.safetensors");
  EXPECT_EQ(style["name"], "limping");
  EXPECT_EQ(style["learnt"], true);
  EXPECT_EQ(style["origin"], "limp.bvh");
  EXPECT_EQ(style["bytes"], read("limping.safetensors").size());
  EXPECT_EQ(style["trunk"].get<std::string>().size(), 16u);
}

TEST_F(StylesVerb, says_what_it_did_and_what_came_of_it) {
  const Ran taken = run("styles mine.safetensors --extract limping -o limping.safetensors");
  EXPECT_EQ(taken.out, "copied 'limping' from mine.safetensors to limping.safetensors, which has " +
                           size_of("limping.safetensors") + " bytes\n");
  const auto expect_line = [&](const Words& arguments, const std::string& deed) {
    const Ran ran = must(arguments);
    EXPECT_EQ(ran.out, deed + " now and " + size_of("mine.safetensors") + " bytes\n");
  };
  expect_line("styles mine.safetensors --remove limping sad",
              "removed 'limping', 'sad' from mine.safetensors, which has 3 styles");
  expect_line("styles mine.safetensors --add limping.safetensors",
              "added 'limping' to mine.safetensors, which has 4 styles");
  expect_line("styles mine.safetensors --rename old=aged",
              "renamed 'old' to 'aged' in mine.safetensors, which has 4 styles");
}

TEST_F(StylesVerb, a_style_put_back_styles_a_walk_as_before) {
  write_walk("walk.bvh");
  const auto stylize = [&](const std::string& model, const std::string& style,
                           const std::string& out) {
    must({"stylize", "walk.bvh", "--style", style, "-o", out}, model);
    return read(out);
  };
  const std::string old = stylize("mine.safetensors", "old=1", "old.bvh");
  const std::string limping = stylize("mine.safetensors", "limping=1", "limping.bvh");
  for (const std::string name : {"old", "limping"}) {
    must({"styles", "mine.safetensors", "--extract", name, "-o", name + ".safetensors"});
  }
  must("styles mine.safetensors --remove old limping");
  EXPECT_EQ(styles_of("mine.safetensors"), (Names{"angry", "proud", "sad"}));
  must("styles mine.safetensors --add limping.safetensors old.safetensors");
  EXPECT_EQ(styles_of("mine.safetensors"), (Names{"angry", "proud", "sad", "old", "limping"}));
  EXPECT_TRUE(stylize("mine.safetensors", "old=1", "old-again.bvh") == old);
  EXPECT_TRUE(stylize("mine.safetensors", "limping=1", "limping-again.bvh") == limping);
  EXPECT_FALSE(old == limping);
}

// From the model that the program finds by itself, as panache learn begins with it.
TEST_F(StylesVerb, a_learnt_style_is_small_and_moves_the_same_after_a_journey) {
  write_walk("walk.bvh", 200);
  const auto done = [&](const Words& arguments) { must(arguments, ""); };
  done("stylize walk.bvh --style old=1 -o old.bvh");
  done("learn walk.bvh old.bvh --name bent --into new.safetensors");
  done("styles new.safetensors --extract bent -o bent.safetensors");
  write_int8("bent.safetensors");
  EXPECT_LE(read("bent.safetensors").size(), 110'000u);
  EXPECT_LE(read("int8.safetensors").size(), 55'000u);
  const std::string model = read("new.safetensors");
  done("styles new.safetensors --remove bent");
  EXPECT_LT(read("new.safetensors").size(), model.size());
  done("styles new.safetensors --add bent.safetensors");
  EXPECT_TRUE(read("new.safetensors") == model);
  done("styles new.safetensors --add int8.safetensors --force");
  done("stylize walk.bvh --model new.safetensors --style bent=1 -o b.bvh");
}

TEST_F(StylesVerb, a_style_gets_another_name) {
  must({"styles", "mine.safetensors", "--rename", "limping=lahm und müde"});
  EXPECT_EQ(styles_of("mine.safetensors").back(), "lahm und müde");
  expect_rejected({"styles", "mine.safetensors", "--rename", "old=lahm, alt"}, 1,
                  "style name 'lahm, alt': holds a ',', which separates names from strengths");
}

TEST_F(StylesVerb, tells_machines_what_a_changed_model_is) {
  const Ran ran = must("styles mine.safetensors --remove old --json");
  EXPECT_EQ(nlohmann::json::parse(ran.out)["styles"].size(), 4u);
}

TEST_F(StylesVerb, a_link_to_a_model_stays_a_link) {
  std::filesystem::create_symlink("mine.safetensors", path("link.safetensors"));
  must("styles link.safetensors --remove old");
  EXPECT_TRUE(std::filesystem::is_symlink(path("link.safetensors")));
  EXPECT_EQ(styles_of("mine.safetensors").size(), 4u);
}

TEST_F(StylesVerb, a_read_only_model_stays_as_it_is) {
  using std::filesystem::perms;
  std::filesystem::permissions(path("mine.safetensors"), perms::owner_read);
  expect_rejected(
      "styles mine.safetensors --remove old", 1,
      "mine.safetensors: is read-only and stays as it is; change a copy of it, or allow "
      "writing");
}

TEST_F(StylesVerb, a_model_that_is_not_named_is_never_changed) {
  const std::string message =
      "--add, --remove and --rename change a model in its place; expected its name, as in panache "
      "styles model.safetensors --remove old";
  expect_rejected("styles --remove old", 2, message);
  expect_rejected("styles --rename old=new", 2, message);
  expect_rejected("styles --add mine.safetensors", 2, message);
}

TEST_F(StylesVerb, does_one_thing_at_a_time) {
  const std::string one = "--extract, --add, --remove and --rename: expected one of them at a time";
  expect_rejected("styles mine.safetensors --remove old --rename sad=blue", 2, one);
  expect_rejected("styles mine.safetensors --add x --extract sad -o y", 2, one);
  const std::string both = "--extract NAME and --output FILE: expected both or neither";
  expect_rejected("styles mine.safetensors --extract old", 2, both);
  expect_rejected("styles mine.safetensors -o old.safetensors", 2, both);
  expect_rejected("styles mine.safetensors --rename old", 2, "--rename old: expected OLD=NEW");
}

TEST_F(StylesVerb, all_of_a_change_happens_or_nothing) {
  expect_rejected("styles mine.safetensors --remove old olld", 1,
                  "unknown style 'olld'; expected angry, proud, sad or limping");
  must("styles mine.safetensors --extract old -o old.safetensors");
  must("styles mine.safetensors --remove old");
  expect_rejected("styles mine.safetensors --add old.safetensors none.safetensors", 1,
                  "none.safetensors: cannot be read: No such file or directory");
}

TEST_F(StylesVerb, a_taken_name_is_replaced_by_force_only) {
  must("styles mine.safetensors --extract old -o old.safetensors");
  expect_rejected("styles mine.safetensors --add old.safetensors", 1,
                  "mine.safetensors: has a style 'old' already; replace it or give one of the two "
                  "another name (--force, --rename)");
  const std::string before = read("mine.safetensors");
  must("styles mine.safetensors --add old.safetensors --force");
  EXPECT_TRUE(read("mine.safetensors") == before);
  expect_rejected("styles mine.safetensors --extract sad -o old.safetensors", 1,
                  "old.safetensors: exists already; --force overwrites it");
}

TEST_F(StylesVerb, explains_what_is_no_style_and_what_is_no_model) {
  expect_rejected("styles mine.safetensors --add model.safetensors", 1,
                  "model.safetensors: is a model; expected a style file, as panache styles "
                  "MODEL --extract NAME -o FILE makes one");
  expect_rejected("styles mine.safetensors --extract old -o old.bin", 2,
                  "old.bin: expected a name that ends in .safetensors");
  must("styles mine.safetensors --extract old -o old.safetensors");
  expect_rejected("styles old.safetensors --remove old", 1,
                  "old.safetensors: is a style file, not a model; panache styles MODEL --add FILE "
                  "puts it into one");
}

TEST_F(StylesVerb, a_style_of_another_model_is_rejected) {
  write("other.safetensors", format_safetensors(make_model({"young"}, 2)));
  must("styles other.safetensors --extract young -o young.safetensors");
  const std::string before = read("mine.safetensors");
  const Ran ran = run("styles mine.safetensors --add young.safetensors");
  EXPECT_EQ(ran.exit, 1);
  EXPECT_TRUE(holds(ran.err, "young.safetensors: is a style of another model"));
  EXPECT_TRUE(read("mine.safetensors") == before);
}

}  // namespace
}  // namespace panache::test
