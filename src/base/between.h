#pragma once
// Lists of numbers at fractional indices.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace panache {

// The number at the index `at` of a list that is not empty, linear between its neighbours; before
// the first and after the last it is that one.
inline double between(const std::vector<double>& list, double at) {
  const size_t a = std::min(static_cast<size_t>(std::max(at, 0.0)), list.size() - 1);
  const size_t b = std::min(a + 1, list.size() - 1);
  return std::lerp(list[a], list[b], at - static_cast<double>(a));
}

}  // namespace panache
