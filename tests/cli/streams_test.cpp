// "-": motion through stdin and stdout.

#include <nlohmann/json.hpp>

#include "cli/program.h"

namespace panache::test {
namespace {

class Streams : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    write_walk("walk.bvh");
    ASSERT_EQ(run({"stylize", "walk.bvh", "--style", "old=1", "-o", "old.bvh"}).exit, 0);
  }
};

TEST_F(Streams, a_pipe_gives_what_files_give) {
  for (const bool named : {false, true}) {
    std::vector<std::string> arguments = {"stylize", "-", "--style", "old=1"};
    if (named) arguments.insert(arguments.end(), {"-o", "-"});
    const Ran ran = run_on("walk.bvh", arguments);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    EXPECT_EQ(ran.out, read("old.bvh"));
    EXPECT_TRUE(ran.err.starts_with("restyled stdin.bvh into stdout.bvh (")) << ran.err;
  }
  EXPECT_EQ(entries(), (std::vector<std::string>{"model.safetensors", "old.bvh", "walk.bvh"}));
}

TEST_F(Streams, each_end_may_be_a_file) {
  ASSERT_EQ(run_on("walk.bvh", {"stylize", "-", "--style", "old=1", "-o", "in.bvh"}).exit, 0);
  EXPECT_EQ(read("in.bvh"), read("old.bvh"));
  const Ran out = run({"stylize", "walk.bvh", "--style", "old=1", "-o", "-", "--quiet"});
  EXPECT_EQ(out.out, read("old.bvh"));
  EXPECT_EQ(out.err, "");
}

TEST_F(Streams, formats_are_told_by_content) {
  const Ran glb = run_on("walk.bvh", {"convert", "-", "--to", "glb"});
  EXPECT_EQ(glb.exit, 0) << glb.err;
  EXPECT_TRUE(glb.out.starts_with("glTF"));
  write("walk.glb", glb.out);
  const Ran styled = run_on("walk.glb", {"stylize", "-", "--style", "old=1"});
  EXPECT_EQ(styled.exit, 0) << styled.err;
  ASSERT_EQ(run({"stylize", "walk.glb", "--style", "old=1", "-o", "old.glb"}).exit, 0);
  // But for the name of the motion, which is that of the file where it has none of its own.
  EXPECT_EQ(styled.out.size(), read("old.glb").size());
  EXPECT_TRUE(
      run_on("walk.glb", {"convert", "-", "-o", "-", "--to", "bvh"}).out.starts_with("HIERARCHY"));
}

TEST_F(Streams, the_walker_walks_into_a_pipe) {
  const Ran ran = run({"walker", "--seconds", "1", "-o", "-"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(ran.out.starts_with("HIERARCHY"));
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
  const auto expect_rejected = [&](const std::string& input, std::vector<std::string> arguments,
                                   const std::string& message) {
    arguments.insert(arguments.begin(), {"stylize", "-", "--style", "old=1"});
    const Ran ran = run_on(input, arguments);
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
  const Ran bad = run_on("bad.bvh", {"stylize", "-", "--style", "old=1"});
  EXPECT_EQ(bad.exit, 1);
  EXPECT_TRUE(bad.err.starts_with("panache: stdin.bvh:")) << bad.err;
}

}  // namespace
}  // namespace panache::test
