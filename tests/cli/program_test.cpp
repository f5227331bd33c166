// The program's other verbs, and what all of them share.

#include <nlohmann/json.hpp>

#include "cli/program.h"
#include "clip/motion_file.h"

namespace panache::test {
namespace {

using Program = ProgramTest;

TEST_F(Program, every_verb_has_help_with_an_example) {
  const std::string all = run("--help").out;
  for (const std::string verb :
       {"stylize", "learn", "retarget", "convert", "info", "styles", "walker", "live", "view"}) {
    const Ran ran = must({verb, "--help"});
    EXPECT_TRUE(holds(ran.out, "Example")) << verb << "\n" << ran.out;
    EXPECT_EQ(ran.err, "");
    EXPECT_TRUE(holds(all, "\n  " + verb)) << verb;
    EXPECT_EQ(run({"help", verb}).out, ran.out);
  }
  EXPECT_EQ(run("help").out, all);
  EXPECT_EQ(run("help live send").out, run("live send --help").out);
  EXPECT_TRUE(holds(run("live send --help").out, "\n  panache live send walk.bvh"));
  const Ran unknown = run("help stilyze");
  EXPECT_EQ(unknown.exit, 2);
  EXPECT_TRUE(begins(unknown.err, "panache: there is no command 'stilyze'; the nearest is "));
}

TEST_F(Program, it_tells_its_version_and_lists_styles_with_what_they_look_like) {
  EXPECT_TRUE(begins(must("--version").out, "panache 0."));
  const Ran ran = must("styles");
  EXPECT_TRUE(holds(ran.out, "  angry  looks angry\n  old    looks old\n"));
  EXPECT_TRUE(holds(ran.out, "data licence CC0\n"));
}

TEST_F(Program, styles_tells_machines) {
  const auto model = nlohmann::json::parse(run("styles model.safetensors --json").out);
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
  const Ran ran = must("info model.safetensors");
  EXPECT_TRUE(holds(ran.out, "4 styles:\n"));
  EXPECT_TRUE(holds(ran.out, "  window          6 poses 0.05 s apart\n"));
  const auto model = nlohmann::json::parse(run("info model.safetensors --json").out);
  EXPECT_EQ(model["metadata"]["format_version"], "1");
}

TEST_F(Program, the_shipped_model_is_found_where_the_program_is) {
  std::filesystem::create_directories(path("prefix/bin"));
  std::filesystem::copy_file(PANACHE_PROGRAM, path("prefix/bin/panache"));
  const auto styles = [&] { return run("styles", "", path("prefix/bin/panache")); };
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
    EXPECT_TRUE(begins(found.out, path(folder) + "panache-int8.safetensors\n"));
  }
}

TEST_F(Program, names_that_are_no_utf8_do_not_stop_the_machine_output) {
  const std::string name = "w\xe4lk.bvh";
  write_walk(name);
  const Ran ran = must({"stylize", name, "--style", "old=1", "--json", "-o", "out/"});
  EXPECT_EQ(nlohmann::json::parse(ran.out)[0]["ok"], true);
  EXPECT_TRUE(exists("out/" + name));
}

// "-": motion through stdin and stdout.

class Streams : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_walk("walk.bvh");
    must("stylize walk.bvh --style old=1 -o old.bvh");
  }
};

TEST_F(Streams, a_pipe_gives_what_files_give) {
  for (const bool named : {false, true}) {
    Words arguments = "stylize - --style old=1";
    if (named) arguments.insert(arguments.end(), {"-o", "-"});
    const Ran ran = run_on("walk.bvh", arguments);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.out, read("old.bvh"));
    EXPECT_TRUE(begins(ran.err, "restyled stdin.bvh into stdout.bvh ("));
  }
  EXPECT_EQ(entries(), (std::vector<std::string>{"model.safetensors", "old.bvh", "walk.bvh"}));
}

TEST_F(Streams, each_end_may_be_a_file) {
  ASSERT_EQ(run_on("walk.bvh", "stylize - --style old=1 -o in.bvh").exit, 0);
  EXPECT_EQ(read("in.bvh"), read("old.bvh"));
  const Ran out = run("stylize walk.bvh --style old=1 -o - --quiet");
  EXPECT_EQ(out.out, read("old.bvh"));
  EXPECT_EQ(out.err, "");
}

TEST_F(Streams, formats_are_told_by_content) {
  const Ran glb = run_on("walk.bvh", "convert - --to glb");
  EXPECT_EQ(glb.exit, 0) << glb.err;
  EXPECT_TRUE(begins(glb.out, "glTF"));
  write("walk.glb", glb.out);
  const Ran styled = run_on("walk.glb", "stylize - --style old=1");
  EXPECT_EQ(styled.exit, 0) << styled.err;
  must("stylize walk.glb --style old=1 -o old.glb");
  // But for the name of the motion, which is that of the file where it has none of its own.
  EXPECT_EQ(styled.out.size(), read("old.glb").size());
  EXPECT_TRUE(run_on("walk.glb", "convert - -o - --to bvh").out.starts_with("HIERARCHY"));
}

TEST_F(Streams, the_walker_walks_into_a_pipe) {
  const Ran ran = must("walker --seconds 1 -o -");
  EXPECT_TRUE(begins(ran.out, "HIERARCHY"));
  EXPECT_EQ(ran.err, "");
}

TEST_F(Streams, output_that_is_lost_is_an_error) {
  const std::string full = "panache: stdout: cannot be written: No space left on device\n";
  for (const std::string verb :
       {"info walk.bvh", "info walk.bvh --json", "styles", "styles --json", "--version",
        "help info", "convert walk.bvh -o a.glb --force --json",
        "convert walk.bvh -o a.glb --force", "stylize walk.bvh --style old=1 --dry-run"}) {
    const Ran ran =
        run({"-c", PANACHE_PROGRAM " " + verb + " >/dev/full"}, "model.safetensors", "/bin/sh");
    EXPECT_EQ(ran.exit, 1) << verb;
    EXPECT_EQ(ran.err, full) << verb;
  }
  const Ran motion =
      run({"-c", PANACHE_PROGRAM " stylize walk.bvh --style old=1 -o - --quiet >/dev/full"},
          "model.safetensors", "/bin/sh");
  EXPECT_EQ(motion.exit, 1);
  EXPECT_EQ(motion.err, full);  // Once.
  // A reader that leaves is no failure to tell of, also where its signal is ignored.
  for (const std::string ignored : {"", "trap '' PIPE; "}) {
    const Ran head = run({"-c", ignored + "(sleep 0.1; " PANACHE_PROGRAM " styles) | true"},
                         "model.safetensors", "/bin/sh");
    EXPECT_EQ(head.err, "");
  }
}

TEST_F(Streams, what_cannot_be_is_rejected) {
  const auto expect_rejected = [&](const std::string& input, const Words& arguments,
                                   const std::string& message) {
    const Ran ran = run_on(input, "stylize - --style old=1" + arguments);
    EXPECT_EQ(ran.exit, 2);
    EXPECT_EQ(ran.out, "");
    EXPECT_EQ(ran.err, "panache: " + message + "\n");
  };
  write("empty", "");
  write("text", "a text");
  expect_rejected("empty", {}, "stdin: is empty; expected a motion file");
  expect_rejected("text", {},
                  "stdin: expected a BVH, glTF, GLB, VRM, VRMA or NPZ file, found something else");
  expect_rejected("walk.bvh", {"walk.bvh"},
                  "- (standard input) cannot be combined with other inputs; found 2 inputs");
  expect_rejected("walk.bvh", {"--json"},
                  "--json: stdout takes the motion; --report FILE writes the same");
  write("bad.bvh", "HIERARCHY\n");
  const Ran bad = run_on("bad.bvh", "stylize - --style old=1");
  EXPECT_EQ(bad.exit, 1);
  EXPECT_TRUE(begins(bad.err, "panache: stdin.bvh:"));
}

// panache walker: sample input on any machine.

using WalkerVerb = ProgramTest;

TEST_F(WalkerVerb, makes_a_walk_that_stylize_takes) {
  const Ran ran = must("walker -o walk.bvh --seconds 2 --fps 30");
  EXPECT_EQ(ran.out, "walked 2.0 s (60 frames) into walk.bvh\n");
  const auto file = read_motion(path("walk.bvh"));
  ASSERT_TRUE(file.ok()) << file.error().message;
  EXPECT_EQ((*file)->clip().frames, 60);
  // 1.4 m/s for 59 frame times, to a tenth: the body sways.
  const Vec3 begin = (*file)->clip().pose(0).translations[0];
  const Vec3 end = (*file)->clip().pose(59).translations[0];
  EXPECT_NEAR(length(end - begin), 1.4f * 59 / 30, 0.1f * 1.4f * 59 / 30);
  must("stylize walk.bvh --style old=1 -o old.bvh");
}

}  // namespace
}  // namespace panache::test
