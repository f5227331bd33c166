// panache train, where it cannot go on.
#include <filesystem>

#include "cli/program.h"
#include "make_manifest.h"

namespace panache {
namespace {

using Train = test::ProgramTest;

TEST_F(Train, a_checkpoint_that_cannot_be_saved_ends_it_with_one_message) {
  test::write_manifest(path(""));
  // Where a checkpoint is to be written there is a link into a folder that does not exist.
  std::filesystem::create_symlink("none/x", path("mine.safetensors.pose.checkpoint"));
  const test::Ran ran = run({"train", "manifest.csv", "--steps", "5", "-o", "mine.safetensors"});
  EXPECT_EQ(ran.exit, 1);
  EXPECT_NE(ran.err.find("panache: mine.safetensors.pose.checkpoint: cannot be written"),
            std::string::npos)
      << ran.err;
  const std::string last = ran.err.substr(ran.err.find("panache: "));
  EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 1) << ran.err;
  EXPECT_FALSE(exists("mine.safetensors"));
}

TEST_F(Train, motion_without_styles_is_only_for_recipes_that_can_use_it) {
  test::write_manifest(path(""));
  const std::vector<std::string> command = {"train",    "manifest.csv",    "--unlabelled",
                                            "pool.csv", "--steps",         "5",
                                            "-o",       "mine.safetensors"};
  test::Ran ran = run(command);
  EXPECT_EQ(ran.exit, 1);
  EXPECT_NE(ran.err.find("pool.csv"), std::string::npos) << ran.err;
  write("pool.csv", "path,style,content,take,neutral,split\nneutral.bvh,any,walk,001,1,train\n");
  std::vector<std::string> smith = command;
  smith.insert(smith.end(), {"--recipe", "smith2019"});
  ran = run(smith);
  EXPECT_EQ(ran.exit, 1);
  EXPECT_EQ(ran.err,
            "panache: --unlabelled: recipe smith2019 learns from styled takes alone; leave the "
            "option out\n");
  EXPECT_FALSE(exists("mine.safetensors"));
}

TEST_F(Train, manifests_may_name_files_that_only_the_program_reads) {
  test::write_manifest(path(""));
  const test::Ran converted = run({"convert", "neutral.bvh", "-o", "neutral.npz"});
  if (converted.exit != 0) GTEST_SKIP() << "this build has no libzip";
  write("pool.csv", "path,style,content,take,neutral,split\nneutral.npz,any,walk,001,1,train\n");
  const test::Ran ran =
      run({"train", "--unlabelled", "pool.csv", "--steps", "5", "-o", "base.safetensors"});
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_TRUE(exists("base.safetensors"));
}

TEST_F(Train, motion_without_styles_alone_makes_a_base) {
  test::write_manifest(path(""));
  write("pool.csv", "path,style,content,take,neutral,split\nneutral.bvh,any,walk,001,1,train\n");
  const std::vector<std::string> command = {"train", "--unlabelled", "pool.csv",        "--steps",
                                            "5",     "-o",           "base.safetensors"};
  test::Ran ran = run(command);
  EXPECT_EQ(ran.exit, 0) << ran.err;
  EXPECT_NE(ran.out.find("0 styles"), std::string::npos) << ran.out;
  ran = run({"styles", "base.safetensors"});
  EXPECT_NE(ran.out.find("no styles yet: panache learn adds them\n"), std::string::npos) << ran.out;
  EXPECT_EQ(run({"stylize", "neutral.bvh", "--model", "base.safetensors", "--style", "old=1", "-o",
                 "out.bvh"})
                .err,
            "panache: unknown style 'old'; the model has no styles yet; panache learn adds one\n");
  std::vector<std::string> smith = command;
  smith.insert(smith.end(), {"--recipe", "smith2019", "--force"});
  EXPECT_EQ(run(smith).err,
            "panache: --unlabelled: recipe smith2019 learns from styled takes alone; leave the "
            "option out\n");
}

TEST_F(Train, motion_of_any_kind_is_needed) {
  const test::Ran ran = run({"train", "-o", "mine.safetensors"});
  EXPECT_EQ(ran.exit, 2);
  EXPECT_EQ(ran.err,
            "panache: expected manifests of styled motion, or --unlabelled alone for a base that "
            "styles are learnt on\n");
}

}  // namespace
}  // namespace panache
