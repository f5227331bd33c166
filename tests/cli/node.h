#pragma once
// Other people's programs for glTF, under Node, on files of a test.

#include <cstdlib>
#include <filesystem>
#include <string>

#include "cli/program.h"

namespace panache::test {

// Why Node or the packages of tests/web cannot be used, or "".
inline std::string missing_node() {
  if (std::system("command -v node > /dev/null 2>&1") != 0) return "there is no node";
  const bool installed = std::filesystem::exists(PANACHE_SOURCE_DIR "/tests/web/node_modules");
  return installed ? "" : "npm ci was not run in tests/web";
}

// Runs a script of tests/web in the folder of a test: whether it succeeds. out.txt and err.txt have
// what it says.
inline bool run_node(const ProgramTest& test, const std::string& script,
                     const std::string& arguments) {
  const std::string command = "cd '" + test.path("") +
                              "' && node '" PANACHE_SOURCE_DIR "/tests/web/" + script + "' " +
                              arguments;
  return std::system((command + " > out.txt 2> err.txt").c_str()) == 0;
}

// The Khronos validator finds no error in these files.
inline void expect_valid_gltf(const ProgramTest& test, const std::string& files) {
  if (const std::string what = missing_node(); !what.empty()) GTEST_SKIP() << what;
  EXPECT_TRUE(run_node(test, "validate.mjs", files))
      << test.read("out.txt") << test.read("err.txt");
}

}  // namespace panache::test
