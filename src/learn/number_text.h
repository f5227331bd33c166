#pragma once
// Numbers as messages show them: two decimals.

#include <cstdio>
#include <string>

namespace panache {

inline std::string number_text(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.2f", value);
  return text;
}

}  // namespace panache
