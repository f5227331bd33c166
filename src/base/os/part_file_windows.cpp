#include "base/os/part_file.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <share.h>
#include <sys/stat.h>

namespace panache {

PartFile::~PartFile() {
  const int cause = errno;
  if (file_ >= 0) ::_close(file_);
  if (!name_.empty()) std::remove(name_.c_str());
  errno = cause;
}

// Nobody else can open a file that is not shared.
Result<PartFile> PartFile::open(const std::string& target, const std::string& path) {
  const std::string name = target + ".part";
  int file = -1;
  constexpr int kHow = _O_WRONLY | _O_CREAT | _O_TRUNC | _O_BINARY | _O_NOINHERIT;
  const int failure = ::_sopen_s(&file, name.c_str(), kHow, _SH_DENYRW, _S_IREAD | _S_IWRITE);
  if (failure != 0) return Error{path + ": cannot be written: " + std::strerror(failure)};
  return PartFile(target, name, file);
}

bool PartFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto block = static_cast<unsigned>(std::min<size_t>(bytes.size(), 1u << 30));
    const int count = ::_write(file_, bytes.data(), block);
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  return true;
}

// Windows keeps the rights of a folder for the files in it.
bool PartFile::set_permissions(std::filesystem::perms) { return true; }

bool PartFile::keep() {
  const bool closed = ::_close(std::exchange(file_, -1)) == 0;
  if (!closed) return false;
  if (!::MoveFileExA(name_.c_str(), target_.c_str(), MOVEFILE_REPLACE_EXISTING)) {
    errno = EACCES;
    return false;
  }
  name_.clear();
  return true;
}

}  // namespace panache
