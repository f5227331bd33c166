#pragma once
// A process that can do nothing but compute.

namespace panache::cli {

// Whether this build has a lock (libseccomp).
bool has_lock();

// From now on this process can compute, take memory, write to the open file `out`, and end. It can
// open no file, no socket and no process, and run no code that it brings into memory: each of these
// fails as if it were not permitted (seccomp). False where this build has no lock, or where kernel
// or container permit none: the process is then as free as it was. There is no way back.
bool lock_down(int out);

}  // namespace panache::cli
