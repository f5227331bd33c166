#pragma once
// Motion through stdin and stdout (file name "-"), and printed output.

#include <string>
#include <string_view>

#include "base/result.h"

namespace panache::cli {

inline constexpr std::string_view kStandardStream = "-";

// A file read from stdin.
struct StdinMotion {
  std::string name;  // "stdin.bvh": for messages, with the extension for the detected format.
  std::string bytes;
};

// Reads all of stdin. Rejects formats that cannot be piped: FBX, which a child process reads, and
// .amc, which needs a second file.
Result<StdinMotion> read_stdin();

Result<void> write_stdout(std::string_view bytes);

// Checks that all output was written, without repeating errors of write_stdout(). Call once, at the
// end of the program. Sets errno on failure.
Result<void> finish_stdout();

}  // namespace panache::cli
