#pragma once
// Structs that begin with their own size, so that fields can be added at their ends: a program that
// was compiled with an older header passes fewer bytes, one with a newer header more.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <string>

#include "base/result.h"

namespace panache::api {

// No struct will ever be larger; a larger size was never initialised.
inline constexpr uint32_t kMaxStructBytes = 4096;

// Checks that the struct's size is possible and that all bytes after the `known` ones are 0. `name`
// is its type.
inline Result<void> check_struct(const void* given, size_t known, const std::string& name) {
  uint32_t size;
  std::memcpy(&size, given, sizeof size);
  if (size < sizeof size || size > kMaxStructBytes || size % sizeof size != 0) {
    return Error{name + ": its struct_size is " + std::to_string(size) + ", expected sizeof(" +
                 name + ")"};
  }
  const auto* bytes = static_cast<const unsigned char*>(given);
  if (std::any_of(bytes + std::min<size_t>(known, size), bytes + size,
                  [](unsigned char byte) { return byte != 0; })) {
    return Error{name + ": has fields that this library is too old for; leave them at 0"};
  }
  return {};
}

// The given fields, and `defaults` for missing ones; `given` may be null.
template <class T>
Result<T> read_struct(const T* given, const T& defaults, const std::string& name) {
  T out = defaults;
  if (!given) return out;
  if (auto good = check_struct(given, sizeof(T), name); !good) return good.error();
  std::memcpy(&out, given, std::min<size_t>(given->struct_size, sizeof(T)));
  return out;
}

// Copies `from` into the caller's struct, as far as it fits.
template <class T>
Result<void> write_struct(T from, T* out, const std::string& name) {
  if (auto good = check_struct(out, sizeof(T), name); !good) return good.error();
  from.struct_size = out->struct_size;
  std::memcpy(out, &from, std::min<size_t>(out->struct_size, sizeof(T)));
  return {};
}

}  // namespace panache::api
