#pragma once
// Functions of the operating system. os_posix.cpp and os_windows.cpp each have all of it.

#include <string>

namespace panache {

// Whether messages on stderr are read by a person at a terminal.
bool is_terminal_stderr();

// Whether this process may write to the file at `path`; false for a missing file.
bool is_writable(const std::string& path);

// Whether a file name fits a pattern of a shell: "*" and "?", and "[a-z]" where the system has it.
bool fits_pattern(const std::string& name, const std::string& pattern);

// Calls `handler` at the first Ctrl-C, or other wish that this process end; the second one ends it.
void on_stop_signal(void (*handler)(int));

// A number that no other process of the machine has.
unsigned process_number();

// The path of the running program, without symbolic links; empty if unknown.
std::string program_path();

}  // namespace panache
