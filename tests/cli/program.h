#pragma once
// Runs the built program as a user would, in a folder of its own.

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <gtest/gtest.h>

#include "base/file.h"
#include "clip/bvh.h"
#include "clip/motion_format.h"
#include "make_clip.h"
#include "make_model.h"
#include "net/safetensors.h"

namespace panache::test {

struct Ran {
  int exit = -1;  // -1 where the program was ended by a signal.
  std::string out, err;
};

// Arguments: in a list, or in a text with a space between each two.
struct Words : std::vector<std::string> {
  Words() = default;
  Words(std::initializer_list<std::string> words) : vector(words) {}
  Words(std::vector<std::string> list) : vector(std::move(list)) {}
  Words(const std::string& text) {
    std::istringstream in(text);
    for (std::string word; in >> word;) push_back(word);
  }
  Words(const char* text) : Words(std::string(text)) {}
};
inline Words operator+(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

// Whether a text holds or begins with a part; else it is shown.
inline testing::AssertionResult holds(const std::string& text, const std::string& part) {
  const bool is_there = text.find(part) != std::string::npos;
  return (is_there ? testing::AssertionSuccess() : testing::AssertionFailure()) << text;
}
inline testing::AssertionResult begins(const std::string& text, const std::string& part) {
  return (text.starts_with(part) ? testing::AssertionSuccess() : testing::AssertionFailure())
         << text;
}

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

  // The motion of a file, which has to be readable.
  std::unique_ptr<MotionFile> open(const std::string& name) const {
    Result<std::unique_ptr<MotionFile>> file = read_motion(path(name));
    EXPECT_TRUE(file.ok()) << file.error().message;
    return file ? *std::move(file) : nullptr;
  }

  // Runs the program in the folder. `model` goes into PANACHE_MODEL.
  Ran run(const Words& arguments, const std::string& model = "model.safetensors",
          const std::string& program = PANACHE_PROGRAM) const {
    return finish(start(arguments, model, program));
  }
  // The same with a file as its stdin.
  Ran run_on(const std::string& name, const Words& arguments) const {
    return finish(start(arguments, "model.safetensors", PANACHE_PROGRAM, name));
  }
  // The same where it has to succeed.
  Ran must(const Words& arguments, const std::string& model = "model.safetensors",
           const std::string& program = PANACHE_PROGRAM) const {
    Ran ran = run(arguments, model, program);
    EXPECT_EQ(ran.exit, 0) << ran.err;
    return ran;
  }
  // And where it has nothing to remark.
  void must_quietly(const Words& arguments) const { EXPECT_EQ(must(arguments).err, ""); }
  // The same where it has to fail with this message and exit code: it prints nothing else, and no
  // file comes, goes or changes.
  void expect_rejected(const Words& arguments, int exit, const std::string& message,
                       const std::string& model = "model.safetensors") const {
    const std::string before = contents();
    const Ran ran = run(arguments, model);
    const std::string name = std::filesystem::path(PANACHE_PROGRAM).filename();
    EXPECT_EQ(ran.err, name + ": " + message + "\n");
    EXPECT_EQ(ran.exit, exit);
    EXPECT_EQ(ran.out, "");
    EXPECT_TRUE(contents() == before) << "files changed, came or went: " << message;
  }

  // The two halves of run(). What it says goes to files of this name with .out and .err.
  pid_t start(const Words& arguments, const std::string& model = "model.safetensors",
              const std::string& program = PANACHE_PROGRAM, const std::string& input = "/dev/null",
              const std::string& output = "") const {
    const pid_t child = ::fork();
    if (child == 0) become(program, arguments, model, input, output);
    return child;
  }
  Ran finish(pid_t child, const std::string& output = "") const {
    int status = 0;
    ::waitpid(child, &status, 0);
    const std::string out = output + ".out", err = output + ".err";
    Ran ran{WIFEXITED(status) ? WEXITSTATUS(status) : -1, read(out), read(err)};
    std::filesystem::remove(path(out));
    std::filesystem::remove(path(err));
    return ran;
  }

 private:
  // Names and contents of all files in the folder.
  std::string contents() const {
    std::string all;
    for (const auto& file : std::filesystem::recursive_directory_iterator(folder_)) {
      all += file.path().string() + "\n";
      if (file.is_regular_file()) all += *read_file(file.path()) + "\n";
    }
    return all;
  }
  [[noreturn]] void become(const std::string& program, const Words& arguments,
                           const std::string& model, const std::string& input,
                           const std::string& output) const {
    constexpr int kCreate = O_WRONLY | O_CREAT | O_TRUNC;
    const std::string out = output + ".out", err = output + ".err";
    const bool ready = ::chdir(folder_.c_str()) == 0 &&
                       ::dup2(::open(input.c_str(), O_RDONLY), STDIN_FILENO) >= 0 &&
                       ::dup2(::open(out.c_str(), kCreate, 0600), STDOUT_FILENO) >= 0 &&
                       ::dup2(::open(err.c_str(), kCreate, 0600), STDERR_FILENO) >= 0 &&
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
