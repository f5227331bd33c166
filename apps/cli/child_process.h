#pragma once
// Work that is better done where it cannot hurt: in this program, started again.

#include <functional>
#include <string>

#include "base/result.h"

namespace panache::cli {

// Runs this program again with the arguments `role` and `path`, and with `input` at its standard
// input; returns what it answers through answer_as_child(). `path` stands in front of the message
// of a failure. `breakdown` is the message where the child crashed, went beyond its bounds or
// answers with more than 2 GB. A child that has not ended after `seconds` by the clock is killed,
// and the message says so. It never outlives this process, however that ends. May be called from
// several threads: the child is a program of its own, not a copy of this one, in which a lock that
// another thread held would stay locked for ever.
Result<std::string> run_in_child(const std::string& role, const std::string& path,
                                 const std::string& input, const std::string& breakdown,
                                 int seconds);

// The child's side: what stands at the standard input.
std::string read_input_as_child();

// The child's side: does `work` with what `read` has read, and hands its result to the parent. Both
// have 8 GB of memory and `seconds` of the processor, and what they print goes nowhere. Only `read`
// can reach files: `work` is locked down (sandbox.h), and is not done where that fails; the parent
// then gets a message with `path` in front. Ends with the parent. Returns the exit code.
int answer_as_child(const std::string& path, const std::function<Result<std::string>()>& read,
                    const std::function<Result<std::string>(const std::string&)>& work,
                    int seconds);

}  // namespace panache::cli
