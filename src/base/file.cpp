#include "base/file.h"

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <utility>

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace panache {
namespace {

// TARGET.part, ours alone for as long as it is open: a lock, which ends with the process that holds
// it, tells a file that is being written from one that a killed process left.
class PartFile {
 public:
  // `path` is what messages call the target.
  static Result<PartFile> open(const std::string& target, const std::string& path) {
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
      struct stat opened {
      }, named{};
      if (::fstat(file, &opened) == 0 && ::stat(name.c_str(), &named) == 0 &&
          opened.st_ino == named.st_ino) {
        return part;
      }
      part.name_.clear();
    }
  }
  PartFile(PartFile&& other) noexcept
      : target_(std::move(other.target_)),
        name_(std::exchange(other.name_, {})),
        file_(std::exchange(other.file_, -1)) {}
  PartFile& operator=(PartFile&&) = delete;
  ~PartFile() {
    const int cause = errno;
    if (!name_.empty()) std::remove(name_.c_str());
    if (file_ >= 0) ::close(file_);
    errno = cause;
  }

  // These three set errno where they fail.
  bool write(std::string_view bytes) {
    if (::ftruncate(file_, 0) != 0) return false;
    while (!bytes.empty()) {
      const ssize_t count = ::write(file_, bytes.data(), bytes.size());
      if (count < 0 && errno == EINTR) continue;
      if (count <= 0) return false;
      bytes.remove_prefix(static_cast<size_t>(count));
    }
    return true;
  }
  bool set_permissions(std::filesystem::perms permissions) {
    return ::fchmod(file_, static_cast<mode_t>(permissions)) == 0;
  }
  // Makes it the target.
  bool keep() {
    // Network file systems tell of a full disk only where a file is closed; the lock stays.
    if (::close(::dup(file_)) != 0) return false;
    if (std::rename(name_.c_str(), target_.c_str()) != 0) return false;
    name_.clear();
    return true;
  }

 private:
  PartFile(std::string target, std::string name, int file)
      : target_(std::move(target)), name_(std::move(name)), file_(file) {}
  std::string target_, name_;
  int file_;
};

}  // namespace

Result<std::string> read_file(const std::string& path) {
  std::error_code status;
  if (std::filesystem::is_directory(path, status)) {
    return Error{path + ": is a folder; expected a file"};
  }
  // Closes the file also where the memory for its bytes runs out.
  const auto close = [](std::FILE* open_file) { std::fclose(open_file); };
  const std::unique_ptr<std::FILE, decltype(close)> file(std::fopen(path.c_str(), "rb"), close);
  if (!file) return Error{path + ": cannot be read: " + std::strerror(errno)};
  std::string bytes;
  const auto size = std::filesystem::file_size(path, status);
  if (!status) bytes.reserve(size);
  char block[1 << 16];
  size_t n;
  while ((n = std::fread(block, 1, sizeof block, file.get())) > 0) bytes.append(block, n);
  if (std::ferror(file.get())) return Error{path + ": cannot be read: " + std::strerror(errno)};
  return bytes;
}

Result<void> write_file(const std::string& path, std::string_view bytes, bool force) {
  namespace fs = std::filesystem;
  std::error_code status;
  const fs::file_status there = fs::status(path, status);
  if (fs::is_directory(there)) return Error{path + ": is a folder; expected a file name"};
  if (fs::exists(there) && !fs::is_regular_file(there)) {
    return Error{path +
                 ": is a device, pipe or socket, which is not replaced; expected a file name"};
  }
  if (!force && fs::exists(there)) return Error{path + ": exists already"};
  const fs::path parent = fs::path(path).parent_path();
  if (!parent.empty()) fs::create_directories(parent, status);

  const std::string target = fs::exists(there) ? fs::canonical(path, status).string() : path;
  Result<PartFile> part = PartFile::open(target, path);
  if (!part) return part.error();
  if (!part->write(bytes) || (fs::exists(there) && !part->set_permissions(there.permissions())) ||
      !part->keep()) {
    return Error{path + ": cannot be written: " + std::strerror(errno)};
  }
  return {};
}

}  // namespace panache
