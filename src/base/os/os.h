#pragma once
// Operating system functions, implemented by os_posix.cpp and os_windows.cpp.

#include <string>

namespace panache {

// Whether messages on stderr are read by a person at a terminal.
bool is_terminal_stderr();

// Whether this process may write to the file at `path`; false for a missing file.
bool is_writable(const std::string& path);

// Whether a file name matches a shell pattern: "*" and "?", and "[a-z]" if the system supports it.
bool fits_pattern(const std::string& name, const std::string& pattern);

// Calls `handler` at the first Ctrl-C or other request to stop; the second one ends the process.
void on_stop_signal(void (*handler)(int));

// The process ID, unique on the machine.
unsigned process_number();

// The path of the running program, without symbolic links; empty if unknown.
std::string program_path();

}  // namespace panache
