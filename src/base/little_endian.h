#pragma once
// Little-endian integers in binary files.

#include <cstdint>
#include <string>
#include <string_view>

namespace panache {

// The integer in `bytes`, at most 8 of them.
inline uint64_t little_endian(std::string_view bytes) {
  uint64_t value = 0;
  for (size_t i = bytes.size(); i-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[i]);
  return value;
}

// The lowest `size` bytes of `value`.
inline void append_little_endian(uint64_t value, size_t size, std::string& out) {
  for (size_t i = 0; i < size; ++i) out += static_cast<char>(value >> (8 * i) & 0xff);
}

}  // namespace panache
