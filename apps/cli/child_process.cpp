#include "child_process.h"

#include <cerrno>
#include <cstring>
#include <mutex>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace panache::cli {
namespace {

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

std::string read_all(int file) {
  std::string bytes;
  char part[1 << 16];
  for (;;) {
    const ssize_t done = ::read(file, part, sizeof part);
    if (done < 0 && errno == EINTR) continue;
    if (done <= 0) return bytes;
    bytes.append(part, static_cast<size_t>(done));
  }
}

// '+' and the result, or '-' and the sentence.
[[noreturn]] void become_worker(const std::function<Result<std::string>()>& work, int seconds,
                                int out) {
  limit(RLIMIT_CORE, 0);
  limit(RLIMIT_CPU, static_cast<rlim_t>(seconds));
#ifndef __SANITIZE_ADDRESS__  // It reserves more addresses than there is memory.
  limit(RLIMIT_AS, rlim_t{8} << 30);
#endif
  // What a library says on its way down is not the program's sentence.
  const int nowhere = ::open("/dev/null", O_WRONLY);
  ::dup2(nowhere, STDOUT_FILENO);
  ::dup2(nowhere, STDERR_FILENO);
  try {
    const Result<std::string> done = work();
    const std::string& text = done ? *done : done.error().message;
    const bool sent =
        write_all(out, done ? "+" : "-", 1) && write_all(out, text.data(), text.size());
    ::_exit(sent ? 0 : 1);
  } catch (...) {
    ::_exit(1);
  }
}

}  // namespace

Result<std::string> run_in_child(const std::function<Result<std::string>()>& work, int seconds,
                                 const std::string& breakdown) {
  int ends[2];
  pid_t child = -1;
  {
    // A child that another thread starts in between would hold this pipe open.
    static std::mutex starting;
    const std::lock_guard lock(starting);
    if (::pipe(ends) != 0) return Error{std::string("no pipe to a child: ") + std::strerror(errno)};
    child = ::fork();
    if (child == 0) {
      ::close(ends[0]);
      become_worker(work, seconds, ends[1]);
    }
    ::close(ends[1]);
  }
  std::string answer;
  if (child > 0) answer = read_all(ends[0]);
  ::close(ends[0]);
  if (child < 0) return Error{std::string("no child process: ") + std::strerror(errno)};
  int status = 0;
  while (::waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  const bool well = WIFEXITED(status) && WEXITSTATUS(status) == 0 && !answer.empty();
  if (!well) return Error{breakdown};
  const bool is_error = answer[0] == '-';
  answer.erase(0, 1);
  if (is_error) return Error{answer};
  return answer;
}

}  // namespace panache::cli
