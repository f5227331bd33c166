#pragma once
// Lower case for names and extensions, independent of the locale.

#include <string>

namespace panache {

// A to Z become a to z; other characters stay.
constexpr char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}
inline std::string lower_case(std::string text) {
  for (char& c : text) c = lower_case(c);
  return text;
}

}  // namespace panache
