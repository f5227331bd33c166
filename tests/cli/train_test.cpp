// panache train, where it cannot go on.
#include <filesystem>

#include "cli/program.h"
#include "make_manifest.h"

namespace panache {
namespace {

using Train = test::ProgramTest;

TEST_F(Train, an_error_of_libtorch_ends_it_with_one_message) {
  test::write_manifest(path(""));
  // Where libtorch is to write a checkpoint there is a folder.
  std::filesystem::create_directory(path("mine.safetensors.pose.checkpoint.part"));
  const test::Ran ran = run({"train", "manifest.csv", "--steps", "5", "-o", "mine.safetensors"});
  EXPECT_EQ(ran.exit, 1);
  EXPECT_NE(ran.err.find("panache: internal error: "), std::string::npos) << ran.err;
  const std::string last = ran.err.substr(ran.err.find("panache: "));
  EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 1) << ran.err;
  EXPECT_FALSE(exists("mine.safetensors"));
}

}  // namespace
}  // namespace panache
