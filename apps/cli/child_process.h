#pragma once
// Runs risky work in a child process: this program, started again.

#include <functional>
#include <string>

#include "base/result.h"

namespace panache::cli {

// Runs this program again with the arguments `role` and `path`, and with `input` as its standard
// input; returns what it sends through answer_as_child(). Failure messages begin with `path`.
// `breakdown` is the message if the child crashes, exceeds its limits or answers with more than 2
// GB. A child still running after `seconds` of wall-clock time is killed, and the message says so.
// The child never outlives this process. Thread-safe: the child is a new program, not a fork, in
// which a lock held by another thread would stay locked for ever.
Result<std::string> run_in_child(const std::string& role, const std::string& path,
                                 const std::string& input, const std::string& breakdown,
                                 int seconds);

// In the child: all of the standard input.
std::string read_input_as_child();

// In the child: does `work` on what `read` returns, and sends the result to the parent. Both are
// limited to 8 GB of memory and `seconds` of CPU time, and their output is discarded. Only `read`
// can open files: `work` runs in a sandbox (sandbox.h), or not at all if that fails; then the
// parent gets a message that begins with `path`. Ends with the parent. Returns the exit code.
int answer_as_child(const std::string& path, const std::function<Result<std::string>()>& read,
                    const std::function<Result<std::string>(const std::string&)>& work,
                    int seconds);

}  // namespace panache::cli
