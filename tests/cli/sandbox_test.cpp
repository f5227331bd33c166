// What a locked process can still do. Each attempt is made in a process of its own making.

#include "sandbox.h"

#include <cerrno>
#include <csignal>
#include <functional>
#include <stdexcept>
#include <utility>

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include "cli/program.h"

namespace panache::test {
namespace {

constexpr char kNotLocked = 'n', kDone = 'd', kForbidden = 'f', kOther = 'o';

// What became of `attempt`, which is negative or zero as system calls are, in a locked process.
char attempted(const std::function<long()>& attempt) {
  int ends[2];
  if (::pipe(ends) != 0) return kOther;
  const pid_t child = ::fork();
  if (child == 0) {
    char outcome = kNotLocked;
    if (cli::lock_down(ends[1])) {
      errno = 0;
      outcome = attempt() >= 0 ? kDone : errno == EPERM ? kForbidden : kOther;
    }
    ::_exit(::write(ends[1], &outcome, 1) == 1 ? 0 : 1);
  }
  ::close(ends[1]);
  char outcome = kOther;
  if (::read(ends[0], &outcome, 1) != 1) outcome = kOther;
  ::close(ends[0]);
  ::waitpid(child, nullptr, 0);
  return outcome;
}

class Sandbox : public ProgramTest {
 protected:
  void SetUp() override {
    ProgramTest::SetUp();
    if (attempted([] { return 0; }) == kNotLocked) {
      GTEST_SKIP() << "this kernel or this build cannot lock a process";
    }
    write("here.txt", "here");
    file_ = path("here.txt");
    open_ = ::open(file_.c_str(), O_RDWR);
  }
  void TearDown() override {
    if (open_ >= 0) ::close(open_);
    ProgramTest::TearDown();
  }
  std::string file_;
  int open_ = -1;
};

TEST_F(Sandbox, a_locked_process_reaches_no_file_no_network_and_no_other_process) {
  const std::string fresh = path("fresh.txt");
  const char *file = file_.c_str(), *made = fresh.c_str();
  const std::pair<const char*, std::function<long()>> attempts[] = {
      {"reads a file", [&] { return ::open(file, O_RDONLY); }},
      {"makes a file", [&] { return ::open(made, O_WRONLY | O_CREAT, 0600); }},
      {"makes a file, the old way", [&] { return ::creat(made, 0600); }},
      {"changes an open file", [&] { return ::write(open_, "x", 1); }},
      {"changes an open file, elsewhere", [&] { return ::pwrite(open_, "x", 1, 0); }},
      {"shortens an open file", [&] { return ::ftruncate(open_, 0); }},
      {"removes a file", [&] { return ::unlink(file); }},
      {"renames a file", [&] { return ::rename(file, made); }},
      {"makes a folder", [&] { return ::mkdir(made, 0700); }},
      {"makes a link", [&] { return ::symlink(file, made); }},
      {"changes rights", [&] { return ::chmod(file, 0777); }},
      {"opens a socket", [] { return ::socket(AF_INET, SOCK_STREAM, 0); }},
      {"opens a socket for datagrams", [] { return ::socket(AF_INET, SOCK_DGRAM, 0); }},
      {"opens a local socket", [] { return ::socket(AF_UNIX, SOCK_STREAM, 0); }},
      {"starts a process", [] { return ::fork(); }},
      {"becomes a program",
       [] {
         char* const arguments[] = {nullptr};
         return ::execve("/bin/true", arguments, arguments);
       }},
      {"signals another process", [] { return ::kill(::getppid(), 0); }},
      {"runs memory",
       [] {
         void* memory =
             ::mmap(nullptr, 4096, PROT_READ | PROT_EXEC, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
         return memory == MAP_FAILED ? -1 : 0;
       }},
      {"raises its limits",
       [] {
         const rlimit none = {RLIM_INFINITY, RLIM_INFINITY};
         return ::setrlimit(RLIMIT_CPU, &none);
       }},
  };
  for (const auto& [name, attempt] : attempts) EXPECT_EQ(attempted(attempt), kForbidden) << name;
  EXPECT_EQ(read("here.txt"), "here");
  EXPECT_EQ(entries(), (std::vector<std::string>{"here.txt", "model.safetensors"}));
}

#ifndef PANACHE_SANITIZED  // The sanitizers ask more of the system.
TEST_F(Sandbox, a_locked_process_computes_takes_memory_and_throws) {
  EXPECT_EQ(attempted([] {
              const std::vector<char> large(100 << 20, 'x');
              try {
                throw std::runtime_error(std::string(large.end() - 3, large.end()));
              } catch (const std::exception& error) {
                return std::string(error.what()) == "xxx" ? 0 : -1;
              }
            }),
            kDone);
}
#endif

}  // namespace
}  // namespace panache::test
