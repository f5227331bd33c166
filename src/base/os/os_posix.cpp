#include <csignal>
#include <filesystem>

#include <fnmatch.h>
#include <unistd.h>

#include "base/os/os.h"

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

}  // namespace panache
