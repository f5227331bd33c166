#include "clip/decimal.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdint>

namespace panache {

void append_fixed(std::string& out, double value, int decimals) {
  assert(decimals >= 0 && decimals <= 9);
  if (std::isnan(value)) value = 0;
  value = std::clamp(value, -kLargestNumber, kLargestNumber);
  double scale = 1;
  for (int i = 0; i < decimals; ++i) scale *= 10;
  // At most 1e18, which an int64_t holds.
  const int64_t scaled = std::llround(value * scale);
  uint64_t digits = static_cast<uint64_t>(scaled < 0 ? -scaled : scaled);

  char buffer[24];
  char* const end = buffer + sizeof buffer;
  char* p = end;
  for (int i = 0; i < decimals; ++i, digits /= 10) *--p = static_cast<char>('0' + digits % 10);
  if (decimals > 0) *--p = '.';
  do {
    *--p = static_cast<char>('0' + digits % 10);
    digits /= 10;
  } while (digits > 0);
  if (scaled < 0) *--p = '-';
  out.append(p, static_cast<size_t>(end - p));
}

std::string with_decimals(double value, int decimals) {
  std::string text;
  append_fixed(text, value, decimals);
  return text;
}

int decimals_of(std::string_view number) {
  const size_t point = number.find('.');
  if (point == std::string_view::npos) return 0;
  if (number.find_first_of("eE") != std::string_view::npos) return 0;
  return static_cast<int>(number.size() - point - 1);
}

}  // namespace panache
