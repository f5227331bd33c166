#pragma once
// Interpolation in lists of numbers.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace panache {

// The value at the fractional index `at` of a non-empty list, linearly interpolated; clamped to the
// first and last value.
inline double between(const std::vector<double>& list, double at) {
  const size_t a = std::min(static_cast<size_t>(std::max(at, 0.0)), list.size() - 1);
  const size_t b = std::min(a + 1, list.size() - 1);
  return std::lerp(list[a], list[b], at - static_cast<double>(a));
}

}  // namespace panache
