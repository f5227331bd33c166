#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <utility>

#include <windows.h>

#include <fcntl.h>
#include <io.h>
#include <share.h>
#include <shlwapi.h>
#include <sys/stat.h>

#include "base/os/os.h"
#include "base/os/part_file.h"

namespace panache {

bool is_terminal_stderr() { return ::_isatty(2) != 0; }

bool is_writable(const std::string& path) {
  constexpr int kWrite = 2;
  return ::_access(path.c_str(), kWrite) == 0;
}

bool fits_pattern(const std::string& name, const std::string& pattern) {
  return ::PathMatchSpecA(name.c_str(), pattern.c_str()) != 0;
}

// Windows resets a handler when it calls it.
void on_stop_signal(void (*handler)(int)) { std::signal(SIGINT, handler); }

unsigned process_number() { return ::GetCurrentProcessId(); }

std::string program_path() {
  wchar_t path[1 << 15];  // No path is longer.
  const DWORD size = ::GetModuleFileNameW(nullptr, path, std::size(path));
  return size > 0 && size < std::size(path) ? std::filesystem::path(path).string() : "";
}

PartFile::~PartFile() {
  const int cause = errno;
  if (file_ >= 0) ::_close(file_);
  if (!name_.empty()) std::remove(name_.c_str());
  errno = cause;
}

// Others cannot open a file that is not shared.
int PartFile::create(const std::string& name) {
  int file = -1;
  constexpr int kMode = _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT;
  errno = ::_sopen_s(&file, name.c_str(), kMode, _SH_DENYRW, _S_IREAD | _S_IWRITE);
  return file;
}

bool PartFile::is_abandoned(const std::string& name, long pid) {
  const HANDLE process = ::OpenProcess(SYNCHRONIZE, FALSE, static_cast<DWORD>(pid));
  if (process != nullptr) ::CloseHandle(process);
  if (process != nullptr || ::GetLastError() != ERROR_INVALID_PARAMETER) return false;
  std::error_code status;
  if (!std::filesystem::is_regular_file(std::filesystem::symlink_status(name, status)))
    return false;
  int file = -1;
  if (::_sopen_s(&file, name.c_str(), _O_RDONLY | _O_NOINHERIT, _SH_DENYRW, 0) != 0) return false;
  ::_close(file);
  return true;
}

size_t PartFile::longest_name(const std::filesystem::path&) { return 255; }

bool PartFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const auto block = static_cast<unsigned>(std::min<size_t>(bytes.size(), 1u << 30));
    const int count = ::_write(file_, bytes.data(), block);
    if (count <= 0) return false;
    bytes.remove_prefix(static_cast<size_t>(count));
  }
  return true;
}

// On Windows, files inherit the permissions of their folder.
bool PartFile::set_permissions(std::filesystem::perms) { return true; }

bool PartFile::keep(bool replace) {
  const bool closed = ::_close(std::exchange(file_, -1)) == 0;
  if (!closed) return false;
  if (!::MoveFileExA(name_.c_str(), target_.c_str(), replace ? MOVEFILE_REPLACE_EXISTING : 0)) {
    const DWORD cause = ::GetLastError();
    errno = cause == ERROR_ALREADY_EXISTS || cause == ERROR_FILE_EXISTS ? EEXIST : EACCES;
    return false;
  }
  name_.clear();
  return true;
}

}  // namespace panache
