#pragma once
// Text from files and people, which may contain any bytes: made well-formed, and escaped
// for XML and HTML.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

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

// Names that people type: in lower case, listed in messages, and suggested where one was
// mistyped.

// A to Z become a to z; other characters stay.
constexpr char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
inline std::string lower_case(std::string text) {
  for (char& c : text) c = lower_case(c);
  return text;
}

// At most `count` of `names` that `wanted` probably means, most likely first: at most a third of
// the letters are wrong, or one name is a prefix of the other. Ignores case.
std::vector<std::string> nearest_names(std::string_view wanted,
                                       const std::vector<std::string>& names, size_t count = 3);

// "is a", "are a and b", "are a, b and c": continues "the nearest ".
std::string is_or_are(const std::vector<std::string>& names);

// "a, b or c", with `last` before the last one.
template <class Names>
std::string one_of(const Names& names, const char* last = " or ") {
  std::string text;
  size_t i = 0;
  for (const std::string& name : names) {
    if (i > 0) text += i + 1 < names.size() ? ", " : last;
    text += name;
    ++i;
  }
  return text;
}

}  // namespace panache
