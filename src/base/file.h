#pragma once
// Reads and writes whole files.

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "base/result.h"

namespace panache {

// The largest file, in bytes: an endless one would take all memory.
inline constexpr uint64_t kMaxFileBytes = uint64_t{1} << 31;

// Returns the bytes of the file at `path`. Error messages name the path and the cause ("walk.bvh:
// cannot be read: No such file or directory"). Devices, named pipes and sockets may never end; they
// are rejected unless this process has them open already (/dev/stdin, /dev/fd/N); and so is what
// find_other_content() finds.
Result<std::string> read_file(const std::string& path);

// What a file holds, by its first bytes, that is never what was meant: a pointer of Git LFS, or
// text in UTF-16. The error says how to get the file.
std::optional<Error> find_other_content(std::string_view bytes, const std::string& path);

// Writes `bytes` to `path`, completely or not at all: to a new file next to it, which is then
// renamed. An existing file is an error without `force`, which keeps its permissions; if several
// processes write a new file without it, only one succeeds. Symbolic links are followed. Devices,
// pipes and folders are never replaced. Missing parent folders are created. The new file is
// .NAME.PID.part, with the ID of this process; those that killed processes left for the same NAME
// are removed if they are this user's.
Result<void> write_file(const std::string& path, std::string_view bytes, bool force);

}  // namespace panache
