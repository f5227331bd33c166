#include "child_process.h"

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "messages.h"
#include "sandbox.h"
#include "stop_signal.h"

namespace panache::cli {
namespace {

// The first byte of an answer: a result or an error message.
constexpr char kGood = '+', kBad = '-';
// A compromised library might answer for ever.
constexpr size_t kLargestAnswer = size_t{2} << 30;  // The size limit of any file.

using Clock = std::chrono::steady_clock;

void limit(int what, rlim_t max) {
  const rlimit bound = {max, max};
  ::setrlimit(what, &bound);
}

bool write_all(int file, const char* bytes, size_t count) {
  while (count > 0) {
    const ssize_t done = ::write(file, bytes, count);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return false;
    bytes += done;
    count -= static_cast<size_t>(done);
  }
  return true;
}

// For poll(): at least 0, and rounded up, so that 0 means that time is up.
int milliseconds_until(Clock::time_point end) {
  using std::chrono::milliseconds;
  const auto left = std::chrono::ceil<milliseconds>(end - Clock::now()).count();
  return static_cast<int>(std::clamp<int64_t>(left, 0, 1'000'000'000));
}

// Stops at `end`, when the answer is too large, or soon after Ctrl-C.
std::string read_all(int file, Clock::time_point end) {
  std::string bytes;
  char part[1 << 16];
  for (;;) {
    constexpr int kLookMilliseconds = 100;
    pollfd readable = {file, POLLIN, 0};
    const int left = milliseconds_until(end);
    const int ready = ::poll(&readable, 1, std::min(left, kLookMilliseconds));
    if (stop_asked() || (ready == 0 && left == 0)) return bytes;
    if (ready == 0 || (ready < 0 && errno == EINTR)) continue;
    if (ready < 0) return bytes;
    const ssize_t done = ::read(file, part, sizeof part);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0 || bytes.size() > kLargestAnswer) return bytes;
    bytes.append(part, static_cast<size_t>(done));
  }
}

// An in-memory file, positioned at its start, or -1.
int file_of(const std::string& bytes) {
  const int file = ::memfd_create("input", MFD_CLOEXEC);
  if (file < 0) return -1;
  if (write_all(file, bytes.data(), bytes.size()) && ::lseek(file, 0, SEEK_SET) == 0) return file;
  const int failed = errno;
  ::close(file);
  errno = failed;
  return -1;
}

// Starts this program again with `in` as its standard input and `out` as its standard output;
// returns errno or 0.
int start(std::string role, std::string path, int in, int out, pid_t& child) {
  char name[] = "panache";
  char* const words[] = {name, role.data(), path.data(), nullptr};
  posix_spawn_file_actions_t actions;
  if (const int failed = ::posix_spawn_file_actions_init(&actions)) return failed;
  ::posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  const int failed = ::posix_spawn(&child, "/proc/self/exe", &actions, nullptr, words, environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return failed;
}

// A child that is killed when it goes out of scope.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (id_ > 0) end();
  }

  // True, with the status, if the child ends before `end_of_time`; otherwise kills it.
  bool wait(Clock::time_point end_of_time, int& status) {
    // A child that has sent its whole answer ends soon.
    for (int pause = 1;; pause = std::min(2 * pause, 50)) {
      const pid_t ended = ::waitpid(id_, &status, WNOHANG);
      if (ended == id_) {
        id_ = -1;
        return true;
      }
      const int left = milliseconds_until(end_of_time);
      if (left == 0) break;
      ::poll(nullptr, 0, std::min(pause, left));
    }
    end();
    return false;
  }

 private:
  void end() {
    ::kill(id_, SIGKILL);
    while (::waitpid(id_, nullptr, 0) < 0 && errno == EINTR) {
    }
    id_ = -1;
  }

  pid_t id_;
};

// Has this process killed when the thread that started it, which waits for the answer in `out`,
// ends. False if that has already happened and nobody reads the pipe.
bool end_with_parent(int out) {
  if (::prctl(PR_SET_PDEATHSIG, SIGKILL) != 0) return false;
  pollfd answer = {out, 0, 0};
  return ::poll(&answer, 1, 0) >= 0 && (answer.revents & POLLERR) == 0;
}

}  // namespace

Result<std::string> run_in_child(const std::string& role, const std::string& path,
                                 const std::string& input, const std::string& breakdown,
                                 int seconds) {
  const auto no_child = [&](int failed) {
    return Error{path + ": needs a process of its own, which could not be started: " +
                 std::strerror(failed)};
  };
  const int in = file_of(input);
  if (in < 0) return no_child(errno);
  // Closed on exec, so that children of other threads do not keep this pipe open.
  int ends[2];
  if (::pipe2(ends, O_CLOEXEC) != 0) {
    const int failed = errno;
    ::close(in);
    return no_child(failed);
  }
  const auto end = Clock::now() + std::chrono::seconds(seconds);
  pid_t id = -1;
  const int failed = start(role, path, in, ends[1], id);
  ::close(in);
  ::close(ends[1]);
  Child child(id);
  std::string answer;
  if (!failed) answer = read_all(ends[0], end);
  ::close(ends[0]);
  if (failed) return no_child(failed);
  if (stop_asked()) return Error{path + ": stopped"};
  int status = 0;
  if (!child.wait(end, status)) {
    return Error{path + ": the process that works on it was stopped after " +
                 std::to_string(seconds) +
                 " s; is the machine very busy, or the file larger than it should be?"};
  }
  const bool well = WIFEXITED(status) && WEXITSTATUS(status) == kDone && !answer.empty() &&
                    answer.size() <= kLargestAnswer;
  if (!well) return Error{path + ": " + breakdown};
  const bool is_good = answer[0] == kGood;
  answer.erase(0, 1);
  if (!is_good) return Error{answer};
  return answer;
}

std::string read_input_as_child() { return read_all(STDIN_FILENO, Clock::time_point::max()); }

int answer_as_child(const std::string& path, const std::function<Result<std::string>()>& read,
                    const std::function<Result<std::string>(const std::string&)>& work,
                    int seconds) {
  // What a library prints must not mix with the answer or the program's messages.
  const int out = ::dup(STDOUT_FILENO);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (out < 0 || nowhere < 0 || !end_with_parent(out)) return kBadInput;
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(seconds));
#ifndef PANACHE_SANITIZED  // The sanitizer reserves more address space than there is memory.
  limit(RLIMIT_AS, rlim_t{8} << 30);
#endif
  const auto locked = [&](const std::string& bytes) -> Result<std::string> {
#ifndef PANACHE_SANITIZED  // The sanitizer reads other processes and system files at exit.
    if (has_lock() && !lock_down(out)) {
      return Error{path +
                   ": the process that works on it could not be locked away from files and "
                   "networks; expected a system that permits seccomp, or this motion in another "
                   "format"};
    }
#endif
    return work(bytes);
  };
  try {
    const Result<std::string> bytes = read();
    const Result<std::string> done = bytes ? locked(*bytes) : bytes.error();
    const std::string& text = done ? *done : done.error().message;
    const char mark = done ? kGood : kBad;
    return write_all(out, &mark, 1) && write_all(out, text.data(), text.size()) ? kDone : kBadInput;
  } catch (...) {
    return kBadInput;
  }
}

}  // namespace panache::cli
