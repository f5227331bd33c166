#pragma once
// Rows of numbers, as kernels take them: one row per character.

#include <cassert>
#include <cstddef>
#include <span>
#include <type_traits>

namespace panache {

// `count` rows; row r starts at first + r * stride. Kernels take them by reference: copies
// are read in larger pieces than they were written in, which a processor waits for.
template <class T>
struct Rows {
  T* first = nullptr;
  size_t count = 0, stride = 0;

  T* row(size_t r) const { return first + r * stride; }
  // The same rows from their number `skip` on.
  Rows from(size_t skip) const { return {first + skip, count, stride}; }
  operator Rows<const T>() const requires(!std::is_const_v<T>) { return {first, count, stride}; }
};

// How many characters the kernels take at a time at best; more are taken in several goes.
inline constexpr size_t kRowsAtOnce = 8;
// Matrices have rows of a multiple of so many outputs where speed matters: as many as the longest
// vector has lanes, so that no kernel has a remainder to see to.
inline constexpr size_t kPadding = 16;
constexpr size_t padded(size_t outputs) { return (outputs + kPadding - 1) / kPadding * kPadding; }

}  // namespace panache
