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
