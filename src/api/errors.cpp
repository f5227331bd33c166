#include "api/errors.h"

#include "base/utf8.h"

namespace panache::api {
namespace {

// Kept per thread: the message that was made last, and the one to show, which is that or a fixed
// one that needs no memory.
thread_local std::string made_error;
thread_local const char* last_error = "";

}  // namespace

panache_status fail(panache_status status, const std::string& message) {
  made_error = to_utf8(message);  // Names and paths may be bytes of any kind.
  last_error = made_error.c_str();
  return status;
}

panache_status fail_without_memory() noexcept {
  last_error = "out of memory";
  return PANACHE_NO_MEMORY;
}

}  // namespace panache::api

const char* panache_last_error(void) { return panache::api::last_error; }
