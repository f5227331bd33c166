// The C interface: checks arguments and calls the library. Here: errors, and the functions without
// an object.
#include "api/errors.h"

#include "api/objects.h"
#include "base/text.h"

namespace panache::api {
namespace {

// Per thread: the message made last, and the one to show, which is either that or a fixed one that
// needs no memory.
thread_local std::string made_error;
thread_local const char* last_error = "";
thread_local panache_error_kind last_kind = PANACHE_ERROR_OTHER;

}  // namespace

panache_status fail(panache_status status, const Error& error) {
  made_error = to_utf8(error.message);  // Names and paths may contain any bytes.
  last_error = made_error.c_str();
  last_kind = static_cast<panache_error_kind>(error.kind);
  return status;
}

panache_status fail_without_memory() noexcept {
  last_error = "out of memory";
  last_kind = PANACHE_ERROR_OTHER;
  return PANACHE_NO_MEMORY;
}

}  // namespace panache::api

const char* panache_last_error(void) { return panache::api::last_error; }

panache_error_kind panache_last_error_kind(void) { return panache::api::last_kind; }

static_assert(static_cast<int>(panache::ErrorKind::bad_style_name) == PANACHE_ERROR_BAD_STYLE_NAME);

int32_t panache_version(void) {
  return 10000 * PANACHE_VERSION_MAJOR + 100 * PANACHE_VERSION_MINOR + PANACHE_VERSION_PATCH;
}

const void* panache_bytes_data(const panache_bytes* bytes) { return bytes->bytes.data(); }

size_t panache_bytes_size(const panache_bytes* bytes) { return bytes->bytes.size(); }

void panache_bytes_destroy(panache_bytes* bytes) { delete bytes; }
