// The C interface: checks arguments and calls the library. Here: the functions without an object.
#include "panache/panache.h"

#include "api/objects.h"

int32_t panache_version(void) {
  return 10000 * PANACHE_VERSION_MAJOR + 100 * PANACHE_VERSION_MINOR + PANACHE_VERSION_PATCH;
}

const void* panache_bytes_data(const panache_bytes* bytes) { return bytes->bytes.data(); }

size_t panache_bytes_size(const panache_bytes* bytes) { return bytes->bytes.size(); }

void panache_bytes_destroy(panache_bytes* bytes) { delete bytes; }
