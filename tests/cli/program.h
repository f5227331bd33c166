#pragma once
// Runs the built program as a user would, in a folder of its own.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "base/file.h"
#include "clip/bvh.h"
#include "make_clip.h"
#include "make_model.h"
#include "net/safetensors.h"

namespace panache::test {

struct Ran {
  int exit = -1;  // -1 where the program was ended by a signal.
  std::string out, err;
};

// Each test works in an empty folder that holds nothing but model.safetensors, with the styles
// angry, old, proud and sad.
class ProgramTest : public testing::Test {
 public:
  void SetUp() override {
    char name[] = "/tmp/panache-test-XXXXXX";
    ASSERT_NE(::mkdtemp(name), nullptr);
    folder_ = name;
    write("model.safetensors", format_safetensors(make_model({"angry", "old", "proud", "sad"})));
  }
  void TearDown() override {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }

  std::string path(const std::string& name) const { return folder_ + "/" + name; }
  bool exists(const std::string& name) const { return std::filesystem::exists(path(name)); }
  std::vector<std::string> entries(const std::string& name = ".") const {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(path(name))) {
      names.push_back(entry.path().filename().string());
    }
    std::sort(names.begin(), names.end());
    return names;
  }
  void write(const std::string& name, const std::string& bytes) const {
    const Result<void> written = write_file(path(name), bytes, true);
    ASSERT_TRUE(written.ok()) << written.error().message;
  }
  std::string read(const std::string& name) const {
    const Result<std::string> bytes = read_file(path(name));
    EXPECT_TRUE(bytes.ok()) << bytes.error().message;
    return bytes ? *bytes : "";
  }
  void write_walk(const std::string& name, int frames = 40) const {
    write(name, format_bvh(walking_clip(frames)));
  }

  // Runs the program in the folder. `model` goes into PANACHE_MODEL.
  Ran run(const std::vector<std::string>& arguments, const std::string& model = "model.safetensors",
          const std::string& program = PANACHE_PROGRAM) const {
    return finish(start(arguments, model, program));
  }
  // The same with a file as its stdin.
  Ran run_on(const std::string& name, const std::vector<std::string>& arguments) const {
    return finish(start(arguments, "model.safetensors", PANACHE_PROGRAM, name));
  }

  // The two halves of run().
  pid_t start(const std::vector<std::string>& arguments,
              const std::string& model = "model.safetensors",
              const std::string& program = PANACHE_PROGRAM,
              const std::string& input = "/dev/null") const {
    const pid_t child = ::fork();
    if (child == 0) become(program, arguments, model, input);
    return child;
  }
  Ran finish(pid_t child) const {
    int status = 0;
    ::waitpid(child, &status, 0);
    Ran ran{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(".out"), read(".err")};
    std::filesystem::remove(path(".out"));
    std::filesystem::remove(path(".err"));
    return ran;
  }

 private:
  [[noreturn]] void become(const std::string& program, const std::vector<std::string>& arguments,
                           const std::string& model, const std::string& input) const {
    constexpr int kCreate = O_WRONLY | O_CREAT | O_TRUNC;
    const bool ready = ::chdir(folder_.c_str()) == 0 &&
                       ::dup2(::open(input.c_str(), O_RDONLY), STDIN_FILENO) >= 0 &&
                       ::dup2(::open(".out", kCreate, 0600), STDOUT_FILENO) >= 0 &&
                       ::dup2(::open(".err", kCreate, 0600), STDERR_FILENO) >= 0 &&
                       ::setenv("PANACHE_MODEL", model.c_str(), 1) == 0;
    std::vector<char*> argv = {const_cast<char*>(program.c_str())};
    for (const std::string& argument : arguments) {
      argv.push_back(const_cast<char*>(argument.c_str()));
    }
    argv.push_back(nullptr);
    if (ready) ::execv(program.c_str(), argv.data());
    ::_exit(127);
  }

  std::string folder_;
};

}  // namespace panache::test
