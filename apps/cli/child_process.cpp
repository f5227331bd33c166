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

namespace panache::cli {
namespace {

// What an answer begins with: a result, or the message of a failure.
constexpr char kGood = '+', kBad = '-';
// A library that somebody has taken over may answer for ever.
constexpr size_t kLargestAnswer = size_t{2} << 30;  // Bytes, as of any file.

using Clock = std::chrono::steady_clock;

void limit(int what, rlim_t most) {
  const rlimit bound = {most, most};
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

// For poll(): at least 0, and rounded up, so that 0 is the end.
int milliseconds_until(Clock::time_point end) {
  using std::chrono::milliseconds;
  const auto left = std::chrono::ceil<milliseconds>(end - Clock::now()).count();
  return static_cast<int>(std::clamp<int64_t>(left, 0, 1'000'000'000));
}

// Stops beyond the largest answer, and at `end`.
std::string read_all(int file, Clock::time_point end) {
  std::string bytes;
  char part[1 << 16];
  for (;;) {
    pollfd readable = {file, POLLIN, 0};
    const int ready = ::poll(&readable, 1, milliseconds_until(end));
    if (ready < 0 && errno == EINTR) continue;
    if (ready <= 0) return bytes;
    const ssize_t done = ::read(file, part, sizeof part);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0 || bytes.size() > kLargestAnswer) return bytes;
    bytes.append(part, static_cast<size_t>(done));
  }
}

// A file in memory from its beginning, or -1.
int file_of(const std::string& bytes) {
  const int file = ::memfd_create("input", MFD_CLOEXEC);
  if (file < 0) return -1;
  if (write_all(file, bytes.data(), bytes.size()) && ::lseek(file, 0, SEEK_SET) == 0) return file;
  const int failed = errno;
  ::close(file);
  errno = failed;
  return -1;
}

// Starts this program again with its standard input coming from `in` and its standard output going
// to `out`; the errno of a failure, or 0.
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

// A child that is killed where nobody waits for it any longer.
class Child {
 public:
  explicit Child(pid_t id) : id_(id) {}
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child() {
    if (id_ > 0) end();
  }

  // Its status when it ends by itself before `end`; false where it has to be killed.
  bool wait(Clock::time_point end_of_time, int& status) {
    // A child whose answer is complete is about to end.
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

// Lets this process be killed when the thread that started it ends, which waits for the answer in
// `out` as long as it lives. False where it has ended already: then nobody reads that pipe.
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
  // Closed in every child, so that none of another thread's holds this pipe open.
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
  // What a library says on its way is not the answer, nor the program's message.
  const int out = ::dup(STDOUT_FILENO);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (out < 0 || nowhere < 0 || !end_with_parent(out)) return kBadInput;
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(seconds));
#ifndef PANACHE_SANITIZED  // It reserves more addresses than there is memory.
  limit(RLIMIT_AS, rlim_t{8} << 30);
#endif
  const auto locked = [&](const std::string& bytes) -> Result<std::string> {
#ifndef PANACHE_SANITIZED  // It looks at other processes and files of the system at the end.
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
