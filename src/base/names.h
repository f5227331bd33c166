#pragma once
// Names that people type: in lower case, listed in messages, and suggested where one was
// mistyped.

#include <string>
#include <string_view>
#include <vector>

namespace panache {

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
inline std::string one_of(const std::vector<std::string>& names, const char* last = " or ") {
  std::string text;
  for (size_t i = 0; i < names.size(); ++i) {
    if (i > 0) text += i + 1 < names.size() ? ", " : last;
    text += names[i];
  }
  return text;
}

}  // namespace panache
