#include <csignal>
#include <filesystem>

#include <windows.h>

#include <io.h>
#include <shlwapi.h>

#include "base/os/os.h"

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

}  // namespace panache
