#include "base/os/part_file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace panache {

PartFile::~PartFile() {
  const int cause = errno;
  if (!name_.empty()) std::remove(name_.c_str());
  if (file_ >= 0) ::close(file_);
  errno = cause;
}

Result<PartFile> PartFile::open(const std::string& target, const std::string& path) {
  const std::string name = target + ".part";
  for (;;) {
    // Without waiting, should there be a pipe of this name.
    constexpr int kHow = O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | O_NONBLOCK;
    const int file = ::open(name.c_str(), kHow, 0666);
    if (file < 0) return Error{path + ": cannot be written: " + std::strerror(errno)};
    PartFile part(target, name, file);
    // Where a file system knows no locks, nobody else's can be in the way.
    if (::flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
      part.name_.clear();  // Another process's, which it will rename or remove.
      return Error{path + ": is being written by another process"};
    }
    // Between opening and locking, its former owner may have renamed it.
    struct stat opened = {}, named = {};
    if (::fstat(file, &opened) == 0 && ::stat(name.c_str(), &named) == 0 &&
        opened.st_ino == named.st_ino) {
      return part;
    }
    part.name_.clear();
  }
}

bool PartFile::write(std::string_view bytes) {
  if (::ftruncate(file_, 0) != 0) return false;
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

bool PartFile::keep() {
  // Network file systems tell of a full disk only where a file is closed; the lock stays.
  const int copy = ::dup(file_);
  if (copy < 0 || ::close(copy) != 0) return false;
  if (std::rename(name_.c_str(), target_.c_str()) != 0) return false;
  name_.clear();
  return true;
}

}  // namespace panache
