#pragma once
// Text that files and file systems give as bytes of any kind.

#include <cstddef>
#include <string>
#include <string_view>

namespace panache {

inline constexpr std::string_view kReplacementCharacter = "\xef\xbf\xbd";  // U+FFFD

// Bytes of the well-formed UTF-8 character that `text`, which is not empty, starts with, 1 to 4; 0
// where it starts with none: over-long forms, surrogates, and what lies beyond U+10FFFF.
size_t utf8_length(std::string_view text) noexcept;

// `text` with each byte that is part of no well-formed character replaced by U+FFFD.
std::string to_utf8(std::string_view text);

}  // namespace panache
