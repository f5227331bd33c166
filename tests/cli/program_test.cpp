// The program's other verbs, and what all of them share.

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace panache::test {
namespace {

using Program = ProgramTest;

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST_F(Program, every_verb_has_help_with_an_example) {
  for (const std::string verb :
       {"stylize", "learn", "retarget", "convert", "info", "styles", "walker", "live", "view"}) {
    const Ran ran = run({verb, "--help"});
    EXPECT_EQ(ran.exit, 0) << verb;
    EXPECT_TRUE(contains(ran.out, "Example")) << verb << "\n" << ran.out;
    EXPECT_EQ(ran.err, "");
    EXPECT_TRUE(contains(run({"--help"}).out, "\n  " + verb)) << verb;
  }
  EXPECT_EQ(run({"help", "live", "send"}).out, run({"live", "send", "--help"}).out);
  EXPECT_TRUE(contains(run({"live", "send", "--help"}).out, "\n  panache live send walk.bvh"));
}

TEST_F(Program, help_is_a_verb_too) {
  EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
  EXPECT_EQ(run({"help", "stylize"}).out, run({"stylize", "--help"}).out);
  EXPECT_EQ(run({"help", "stylize"}).exit, 0);
  const Ran unknown = run({"help", "stilyze"});
  EXPECT_EQ(unknown.exit, 2);
  EXPECT_TRUE(unknown.err.starts_with("panache: there is no command 'stilyze'; the nearest is "))
      << unknown.err;
}

TEST_F(Program, it_tells_its_version) {
  const Ran ran = run({"--version"});
  EXPECT_EQ(ran.exit, 0);
  EXPECT_TRUE(ran.out.starts_with("panache 0.")) << ran.out;
}

TEST_F(Program, styles_lists_names_and_what_they_look_like) {
  const Ran ran = run({"styles"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(contains(ran.out, "  angry  looks angry\n  old    looks old\n")) << ran.out;
  EXPECT_TRUE(contains(ran.out, "data licence CC0\n")) << ran.out;
}

TEST_F(Program, styles_tells_machines) {
  const auto model = nlohmann::json::parse(run({"styles", "model.safetensors", "--json"}).out);
  EXPECT_EQ(model["recipe"], "panache");
  EXPECT_EQ(model["licence"], "CC0");
  EXPECT_EQ(model["bytes"], read("model.safetensors").size());
  ASSERT_EQ(model["styles"].size(), 4u);
  EXPECT_EQ(model["styles"][3]["name"], "sad");
  EXPECT_EQ(model["styles"][3]["description"], "looks sad");
  size_t numbers = 0;
  for (const auto& [name, tensor] : make_model({"angry", "old", "proud", "sad"}).tensors) {
    numbers += tensor.values.size();
  }
  EXPECT_EQ(model["parameters"], numbers);
}

TEST_F(Program, info_shows_all_that_a_model_says_of_itself) {
  const Ran ran = run({"info", "model.safetensors"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(contains(ran.out, "4 styles:\n")) << ran.out;
  EXPECT_TRUE(contains(ran.out, "  window          6 poses 0.05 s apart\n")) << ran.out;
  const auto model = nlohmann::json::parse(run({"info", "model.safetensors", "--json"}).out);
  EXPECT_EQ(model["metadata"]["format_version"], "1");
}

TEST_F(Program, the_shipped_model_is_found_where_the_program_is) {
  std::filesystem::create_directories(path("prefix/bin"));
  std::filesystem::copy_file(PANACHE_PROGRAM, path("prefix/bin/panache"));
  const auto styles = [&] { return run({"styles"}, "", path("prefix/bin/panache")); };
  const Ran none = styles();
  EXPECT_EQ(none.exit, 1);
  EXPECT_EQ(none.out, "");
  std::string looked;
  for (const std::string folder :
       {"prefix/share/panache/models/", "prefix/bin/models/", "models/"}) {
    if (!looked.empty()) looked += ", ";
    looked += path(folder) + "panache-int8.safetensors";
  }
  EXPECT_EQ(none.err, "panache: the model panache-int8.safetensors was not found; searched " +
                          looked +
                          "; --model FILE or the environment variable PANACHE_MODEL names "
                          "another\n");
  // From the last place to look to the first.
  for (const std::string folder :
       {"models/", "prefix/bin/models/", "prefix/share/panache/models/"}) {
    write(folder + "panache-int8.safetensors", read("model.safetensors"));
    const Ran found = styles();
    EXPECT_EQ(found.exit, 0) << found.err;
    EXPECT_TRUE(found.out.starts_with(path(folder) + "panache-int8.safetensors\n")) << found.out;
  }
}

TEST_F(Program, names_that_are_no_utf8_do_not_stop_the_machine_output) {
  const std::string name = "w\xe4lk.bvh";
  write_walk(name);
  const Ran ran = run({"stylize", name, "--style", "old=1", "--json", "-o", "out/"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_EQ(nlohmann::json::parse(ran.out)[0]["ok"], true);
  EXPECT_TRUE(exists("out/" + name));
}

}  // namespace
}  // namespace panache::test
