#pragma once
// Letters of names and extensions, whatever the user's language.

#include <string>

namespace panache {

// A to Z become a to z; all else stays.
constexpr char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
inline std::string lower_case(std::string text) {
  for (char& c : text) c = lower_case(c);
  return text;
}

}  // namespace panache
