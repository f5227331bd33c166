// What the verbs of panache-lab share.

#include "lab_program.h"

namespace panache::test {
namespace {

using LabProgram = LabTest;

TEST_F(LabProgram, every_verb_has_help_with_an_example) {
  const std::string help = run({"--help"}).out;
  for (const std::string verb :
       {"train", "eval", "bench", "strip", "quantize", "export", "fit-walker"}) {
    const Ran ran = run({verb, "--help"});
    EXPECT_EQ(ran.exit, 0) << verb;
    EXPECT_NE(ran.out.find("\n  panache-lab " + verb), std::string::npos) << ran.out;
    EXPECT_NE(help.find("\n  " + verb), std::string::npos) << verb;
  }
}

TEST_F(LabProgram, it_says_its_name) {
  EXPECT_TRUE(run({"--version"}).out.starts_with("panache-lab 0."));
  const Ran ran = run({"stylize", "walk.bvh"});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_TRUE(ran.err.starts_with("panache-lab: there is no command 'stylize'; expected train, "))
      << ran.err;
  EXPECT_EQ(run({"quantize", "model.safetensors", "more", "-o", "out.safetensors"}).err,
            "panache-lab: unexpected argument 'more'; see panache-lab quantize --help\n");
}

TEST_F(LabProgram, fit_walker_says_what_it_lacks) {
  EXPECT_EQ(run({"fit-walker", "none.csv", "-o", "walker.safetensors"}).err,
            "panache-lab: none.csv: cannot be read: No such file or directory\n");
  write("walker.safetensors", "mine");
  EXPECT_EQ(run({"fit-walker", "none.csv", "-o", "walker.safetensors"}).err,
            "panache-lab: walker.safetensors: exists already; --force overwrites it\n");
}

}  // namespace
}  // namespace panache::test
