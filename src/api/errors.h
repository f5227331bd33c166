#pragma once
// Errors of the C interface: a status, and a message kept per thread.

#include "base/result.h"
#include "panache/panache.h"

namespace panache::api {

// Keeps the error for panache_last_error() and returns `status`.
panache_status fail(panache_status status, const Error& error);
// PANACHE_NO_MEMORY, with its message. Needs no memory.
panache_status fail_without_memory() noexcept;

// Runs `work`, which may allocate; no exception may reach C.
template <class Work>
panache_status guarded(Work&& work) noexcept {
  try {
    return work();
  } catch (...) {  // std::bad_alloc, or what containers throw for impossible sizes.
    return fail_without_memory();
  }
}

// Output pointers are NULL until the function succeeds.
template <class T>
void start(T** out) {
  *out = nullptr;
}

}  // namespace panache::api
