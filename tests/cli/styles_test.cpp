// panache styles: styles taken out of models, put into others, removed and renamed.

#include <functional>

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "make_model.h"
#include "net/layer.h"

namespace panache::test {
namespace {

constexpr const char* kGroups = "moods\nages\n\nmoods\n\n";

class StylesVerb : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_mine([](TensorFile& model) { add_learnt(model, 0, "limping", "limp.bvh"); },
               "model.safetensors");
  }
  // mine.safetensors, changed.
  void write_mine(const std::function<void(TensorFile&)>& change,
                  const std::string& from = "mine.safetensors") const {
    TensorFile model = *parse_safetensors(read(from), from);
    change(model);
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
};

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
  write_mine([](TensorFile& model) { model.metadata["style_groups"] = kGroups; });
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
  write_mine([](TensorFile& model) { model.metadata["style_groups"] = kGroups; });
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
  write_mine([](TensorFile& model) {
    model.metadata.erase("style_origins");
    model.metadata["style_descriptions"] = "";
  });
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

TEST_F(StylesVerb, does_one_thing_at_a_time_and_to_a_model_that_is_named) {
  const char* one = "--extract, --add, --remove and --rename: expected one of them at a time";
  const char* both = "--extract NAME and --output FILE: expected both or neither";
  const char* unnamed =
      "--add, --remove and --rename change a model in its place; expected its name, as in panache "
      "styles model.safetensors --remove old";
  const std::pair<const char*, const char*> cases[] = {
      {"styles mine.safetensors --remove old --rename sad=blue", one},
      {"styles mine.safetensors --add x --extract sad -o y", one},
      {"styles mine.safetensors --extract old", both},
      {"styles mine.safetensors -o old.safetensors", both},
      {"styles mine.safetensors --rename old", "--rename old: expected OLD=NEW"},
      {"styles --remove old", unnamed},
      {"styles --rename old=new", unnamed},
      {"styles --add mine.safetensors", unnamed},
  };
  for (const auto& [command, message] : cases) expect_rejected(command, 2, message);
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

}  // namespace
}  // namespace panache::test
