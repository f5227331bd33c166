#pragma once
// Text from files and file systems, which may contain any bytes: made well-formed, and escaped
// for XML and HTML.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace panache {

inline constexpr std::string_view kReplacementCharacter = "\xef\xbf\xbd";  // U+FFFD

// The length in bytes, 1 to 4, of the well-formed UTF-8 character at the start of `text`, which is
// not empty; 0 if there is none: over-long forms, surrogates, and anything beyond U+10FFFF.
size_t utf8_length(std::string_view text) noexcept;

// The number of UTF-8 characters of `text`.
size_t character_count(std::string_view text) noexcept;

// "1 file", "2 files".
std::string plural(uint64_t count, const std::string& noun);

// `text` with each byte outside well-formed characters replaced by U+FFFD.
std::string to_utf8(std::string_view text);

// Any UTF-8 `text`, escaped for use between tags and in double quotes: special characters become
// entities, and characters that XML does not allow become U+FFFD.
std::string xml_escaped(std::string_view text);

}  // namespace panache
