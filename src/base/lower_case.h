#pragma once
// Letters of names and extensions, whatever the user's language.

namespace panache {

// A to Z become a to z; all else stays.
constexpr char lower_case(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

}  // namespace panache
