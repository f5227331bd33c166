// Processes that the program starts for its work: they wait for nothing that may never come, end
// with the program, and do nothing where they cannot be locked.

#include "child_process.h"

#include <cerrno>
#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include <sys/prctl.h>
#include <sys/stat.h>

#include "clip/make_fbx.h"
#include "cli/no_lock.h"
#include "cli/program.h"

namespace panache::test {
namespace {

using std::chrono::steady_clock;

bool becomes_true(const std::function<bool()>& is_true) {
  const auto end = steady_clock::now() + std::chrono::seconds(200);
  while (!is_true()) {
    if (steady_clock::now() > end) return false;
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  return true;
}

class ChildProcess : public ProgramTest {};

TEST_F(ChildProcess, a_named_pipe_is_not_waited_for) {
  for (const std::string extension :
       {"fbx", "bvh", "glb", "gltf", "vrm", "vrma", "npz", "amc", "safetensors", "csv"}) {
    const std::string name = "x." + extension;
    ASSERT_EQ(::mkfifo(path(name).c_str(), 0600), 0);
    const std::vector<std::string> arguments =
        extension == "safetensors" ? std::vector<std::string>{"styles", name}
        : extension == "csv"
            ? std::vector<std::string>{"stylize", "w.bvh", "--strengths", name, "-o", "o.bvh"}
            : std::vector<std::string>{"info", name};
    write_walk("w.bvh");
    const pid_t program = start(arguments);
    siginfo_t ended = {};
    const bool ends = becomes_true([&] {
      return ::waitid(P_PID, static_cast<id_t>(program), &ended, WEXITED | WNOHANG | WNOWAIT) ==
                 0 &&
             ended.si_pid == program;
    });
    if (!ends) ::kill(program, SIGKILL);
    const Ran ran = finish(program);
    EXPECT_GT(ran.exit, 0) << name;
    ASSERT_EQ(ran.err,
              "panache: " + name + ": is a device, pipe or socket; expected a regular file\n");
  }
}

#ifdef PANACHE_ASSIMP
TEST_F(ChildProcess, it_ends_with_the_program_however_that_ends) {
  // Long enough to be caught at it: seconds of work.
  write("long.fbx", format_fbx(walking_clip(20000)));
  // What the program leaves behind comes here, instead of to the first process of the machine.
  ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
  for (const int signal : {SIGINT, SIGTERM, SIGKILL}) {
    for (const bool is_stopped : {false, true}) {
      const pid_t program = start("convert long.fbx --force -o long.glb");
      const std::string id = std::to_string(program);
      const std::string children = "/proc/" + id + "/task/" + id + "/children";
      ASSERT_TRUE(becomes_true([&] { return !read_file(children)->empty(); }));
      const pid_t child = std::stoi(*read_file(children));
      if (is_stopped) {  // At work: from then on its output goes nowhere.
        const std::string output = "/proc/" + std::to_string(child) + "/fd/1";
        std::error_code gone;
        EXPECT_TRUE(becomes_true(
            [&] { return std::filesystem::read_symlink(output, gone) == "/dev/null"; }));
        ::kill(child, SIGSTOP);
      }
      ::kill(program, signal);
      ::waitpid(program, nullptr, 0);
      // It ends by itself, or the program has ended it.
      EXPECT_TRUE(becomes_true([&] {
        const pid_t ended = ::waitpid(child, nullptr, WNOHANG);
        return ended == child || (ended < 0 && errno == ECHILD);
      })) << signal
          << is_stopped;
      ::kill(child, SIGKILL);
    }
  }
  ::prctl(PR_SET_CHILD_SUBREAPER, 0);
}

TEST_F(ChildProcess, without_a_lock_nothing_is_read) {
  write("walk.fbx", format_fbx(walking_clip(5)));
  expect_no_work_without_a_lock(*this, {"convert", "walk.fbx", "-o", "out.glb"}, "walk.fbx");
}
#endif

// What this program does when it is started as a child. These tests are run by the one below only.
TEST(AsChild, DISABLED_never_answers) { ::pause(); }
TEST(AsChild, DISABLED_answers_and_never_ends) {
  ::close(STDOUT_FILENO);
  ::pause();
}

TEST_F(ChildProcess, one_that_takes_too_long_is_stopped) {
  const std::string all = "--gtest_also_run_disabled_tests";  // In the place of a path.
  for (const std::string name : {"never_answers", "answers_and_never_ends"}) {
    const auto begin = steady_clock::now();
    const Result<std::string> answer =
        cli::run_in_child("--gtest_filter=AsChild.DISABLED_" + name, all, "", "breaks down", 1);
    ASSERT_FALSE(answer.ok());
    EXPECT_EQ(answer.error().message,
              all +
                  ": the process that works on it was stopped after 1 s; is the machine very busy, "
                  "or the file larger than it should be?");
    EXPECT_GE(steady_clock::now() - begin, std::chrono::seconds(1));
    EXPECT_EQ(::waitpid(-1, nullptr, WNOHANG), -1);  // It is gone.
  }
}

}  // namespace
}  // namespace panache::test
