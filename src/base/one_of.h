#pragma once
// Lists of names in messages.

#include <string>
#include <vector>

namespace panache {

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
