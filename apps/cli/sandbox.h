#pragma once
// A process that can do nothing but compute.

namespace panache::cli {

// From now on this process can compute, take memory, write to the open file `out`, and end. It can
// open no file, no socket and no process, and run no code that it brings into memory: each of these
// fails as if it were not permitted (seccomp). False where the kernel or this build has no such
// thing; then nothing has changed. There is no way back.
bool lock_down(int out);

}  // namespace panache::cli
