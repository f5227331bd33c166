#pragma once
// Decompression of zlib streams (RFC 1950 and RFC 1951), as binary FBX files contain them.

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace panache {

// The content of `stream`, which must have exactly `size` bytes. Nothing if the stream is
// malformed, has another size or another checksum. Memory is bounded by the stream: a byte of it
// can hold at most kMaxInflation bytes.
std::optional<std::string> inflate(std::string_view stream, size_t size);
inline constexpr size_t kMaxInflation = 1032;

}  // namespace panache
