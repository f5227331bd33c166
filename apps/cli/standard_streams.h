#pragma once
// Motion through stdin and stdout, which the name "-" stands for.

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

}  // namespace panache::cli
