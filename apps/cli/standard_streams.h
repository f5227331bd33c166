#pragma once
// Motion through stdin and stdout, which the name "-" stands for, and what is printed.

#include <string>
#include <string_view>

#include "base/result.h"

namespace panache::cli {

inline constexpr std::string_view kStandardStream = "-";

// A file that came through stdin.
struct StdinMotion {
  std::string name;  // "stdin.bvh": for messages, with the extension that its content has.
  std::string bytes;
};

// All of stdin. Rejects what cannot come that way: FBX, which is read by a process of its own, and
// .amc, which needs a second file.
Result<StdinMotion> read_stdin();

Result<void> write_stdout(std::string_view bytes);

// Whether all that was printed arrived: what write_stdout reports is not reported again. Called
// once, at the end of the program. Sets errno where it fails.
Result<void> finish_stdout();

}  // namespace panache::cli
