#pragma once
// Work that is better done where it cannot hurt.

#include <functional>
#include <string>

#include "base/result.h"

namespace panache::cli {

// The result of `work`, done in a child process that may use 8 GB of memory and `seconds` of the
// processor. `breakdown` is the sentence where it crashed, threw or went beyond its bounds. May be
// called from several threads; `work` must not wait for another thread.
Result<std::string> run_in_child(const std::function<Result<std::string>()>& work, int seconds,
                                 const std::string& breakdown);

}  // namespace panache::cli
