#include "child_process.h"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <spawn.h>
#include <sys/mman.h>
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

// Stops beyond the largest answer.
std::string read_all(int file) {
  std::string bytes;
  char part[1 << 16];
  for (;;) {
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
int start(const std::vector<std::string>& arguments, int in, int out, pid_t& child) {
  std::vector<std::string> words = {"panache"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  pointers.reserve(words.size() + 1);
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  posix_spawn_file_actions_t actions;
  if (const int failed = ::posix_spawn_file_actions_init(&actions)) return failed;
  ::posix_spawn_file_actions_adddup2(&actions, in, STDIN_FILENO);
  ::posix_spawn_file_actions_adddup2(&actions, out, STDOUT_FILENO);
  const int failed =
      ::posix_spawn(&child, "/proc/self/exe", &actions, nullptr, pointers.data(), environ);
  ::posix_spawn_file_actions_destroy(&actions);
  return failed;
}

}  // namespace

Result<std::string> run_in_child(const std::string& role, const std::string& path,
                                 const std::string& input, const std::string& breakdown) {
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
  pid_t child = -1;
  const int failed = start({role, path}, in, ends[1], child);
  ::close(in);
  ::close(ends[1]);
  std::string answer;
  if (!failed) answer = read_all(ends[0]);
  ::close(ends[0]);
  if (failed) return no_child(failed);
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const bool well = WIFEXITED(status) && WEXITSTATUS(status) == kDone && !answer.empty() &&
                    answer.size() <= kLargestAnswer;
  if (!well) return Error{path + ": " + breakdown};
  const bool is_good = answer[0] == kGood;
  answer.erase(0, 1);
  if (!is_good) return Error{answer};
  return answer;
}

std::string read_input_as_child() { return read_all(STDIN_FILENO); }

int answer_as_child(const std::function<Result<std::string>()>& read,
                    const std::function<Result<std::string>(const std::string&)>& work,
                    int seconds) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(seconds));
#ifndef PANACHE_SANITIZED  // It reserves more addresses than there is memory.
  limit(RLIMIT_AS, rlim_t{8} << 30);
#endif
  // What a library says on its way is not the answer, nor the program's message.
  const int out = ::dup(STDOUT_FILENO);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (out < 0 || nowhere < 0) return kBadInput;
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  try {
    const Result<std::string> bytes = read();
#ifndef PANACHE_SANITIZED  // It looks at other processes and files of the system at the end.
    lock_down(out);
#endif
    const Result<std::string> done = bytes ? work(*bytes) : bytes.error();
    const std::string& text = done ? *done : done.error().message;
    const char mark = done ? kGood : kBad;
    return write_all(out, &mark, 1) && write_all(out, text.data(), text.size()) ? kDone : kBadInput;
  } catch (...) {
    return kBadInput;
  }
}

}  // namespace panache::cli
