#pragma once
// Restricts a process to pure computation.

namespace panache::cli {

// Whether this build has a sandbox (libseccomp).
bool has_lock();

// From now on this process can only compute, allocate memory, write to the open file `out`, and
// exit. Opening files or sockets, starting processes and loading code fail with a permission error
// (seccomp). Irreversible. False if this build has no sandbox, or if the kernel or container does
// not permit it: then nothing is restricted.
bool lock_down(int out);

}  // namespace panache::cli
