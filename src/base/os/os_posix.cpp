#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include <fcntl.h>
#include <fnmatch.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include "base/os/os.h"
#include "base/os/part_file.h"

namespace panache {

bool is_terminal_stderr() { return ::isatty(STDERR_FILENO) == 1; }

bool is_writable(const std::string& path) { return ::access(path.c_str(), W_OK) == 0; }

bool fits_pattern(const std::string& name, const std::string& pattern) {
  // Names that begin with a dot are hidden, unless the pattern names the dot.
  return ::fnmatch(pattern.c_str(), name.c_str(), FNM_PERIOD) == 0;
}

void on_stop_signal(void (*handler)(int)) {
  struct sigaction action = {};
  action.sa_handler = handler;
  // Without SA_RESTART, so that blocking calls end at once.
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

unsigned process_number() { return static_cast<unsigned>(::getpid()); }

std::string program_path() {
  std::error_code status;
  return std::filesystem::read_symlink("/proc/self/exe", status).string();
}

PartFile::~PartFile() {
  const int cause = errno;
  if (!name_.empty()) std::remove(name_.c_str());
  if (file_ >= 0) ::close(file_);
  errno = cause;
}

int PartFile::create(const std::string& name) {
  const int file = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC | O_NOFOLLOW, 0666);
  // On a file system without locks, no file counts as abandoned either.
  if (file >= 0) ::flock(file, LOCK_EX | LOCK_NB);
  return file;
}

bool PartFile::is_abandoned(const std::string& name, long pid) {
  if (::kill(static_cast<pid_t>(pid), 0) == 0 || errno != ESRCH) return false;
  // O_NONBLOCK in case there is a pipe of this name.
  const int file = ::open(name.c_str(), O_RDONLY | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK);
  if (file < 0) return false;
  struct stat status = {};
  // The process may be on another machine or in another container; it then holds the lock.
  const bool ours = ::fstat(file, &status) == 0 && S_ISREG(status.st_mode) &&
                    status.st_uid == ::geteuid() && ::flock(file, LOCK_EX | LOCK_NB) == 0;
  ::close(file);
  return ours;
}

size_t PartFile::longest_name(const std::filesystem::path& folder) {
  const long longest = ::pathconf(folder.empty() ? "." : folder.c_str(), _PC_NAME_MAX);
  return longest > 0 ? static_cast<size_t>(longest) : 255;
}

bool PartFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(file_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  return true;
}

bool PartFile::set_permissions(std::filesystem::perms permissions) {
  return ::fchmod(file_, static_cast<mode_t>(permissions)) == 0;
}

bool PartFile::keep(bool replace) {
  // Network file systems report a full disk only when a file is closed; the lock stays.
  const int copy = ::dup(file_);
  if (copy < 0 || ::close(copy) != 0) return false;
  if (!replace) {
    // link() fails if the target exists; the destructor removes the first name.
    if (::link(name_.c_str(), target_.c_str()) == 0) return true;
    if (errno == EEXIST) return false;
    // File systems without links, such as those of memory cards.
    if (::access(target_.c_str(), F_OK) == 0) {
      errno = EEXIST;
      return false;
    }
  }
  if (std::rename(name_.c_str(), target_.c_str()) != 0) return false;
  name_.clear();
  return true;
}

}  // namespace panache
