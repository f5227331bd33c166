// The C interface: checks what comes in, and hands it on. Here is what has no object of its own.
#include "panache/panache.h"

#include "api/objects.h"

int32_t panache_version(void) {
  return 10000 * PANACHE_VERSION_MAJOR + 100 * PANACHE_VERSION_MINOR + PANACHE_VERSION_PATCH;
}

const void* panache_bytes_data(const panache_bytes* bytes) { return bytes->bytes.data(); }

size_t panache_bytes_size(const panache_bytes* bytes) { return bytes->bytes.size(); }

void panache_bytes_destroy(panache_bytes* bytes) { delete bytes; }
