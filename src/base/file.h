#pragma once
// Whole files in, whole files out.

#include <cstdint>
#include <string>
#include <string_view>

#include "base/result.h"

namespace panache {

// The largest file, in bytes: an endless one would take all memory.
inline constexpr uint64_t kMaxFileBytes = uint64_t{1} << 31;

// The bytes of the file at `path`. The message names the path and the cause ("walk.bvh: cannot be
// read: No such file or directory"). Devices, named pipes and sockets are rejected, as they may
// never end, unless this process has them open already (/dev/stdin, /dev/fd/N).
Result<std::string> read_file(const std::string& path);

// Puts `bytes` at `path`, whole or not at all: writes a new file beside it, then renames. An
// existing file is left alone and rejected unless `force`, which keeps its permissions; of several
// processes that write a new file without it, one succeeds. Where a link points is written to. What
// is not a regular file (a device, a pipe, a folder) is never replaced. Missing folders on the way
// are made. The file beside it is .NAME.PID.part, with the number of this process: what a killed
// process left of the same NAME is removed, where it is this user's.
Result<void> write_file(const std::string& path, std::string_view bytes, bool force);

}  // namespace panache
