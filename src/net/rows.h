#pragma once
// Numbers for the kernels: aligned, and in rows, one row per character.

#include <cassert>
#include <cstddef>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

namespace panache {

inline constexpr size_t kCacheLine = 64;  // Bytes; also the longest vector of any instruction set.

template <class T>
struct LineAllocator {
  using value_type = T;
  LineAllocator() = default;
  template <class U>
  LineAllocator(const LineAllocator<U>&) {}
  T* allocate(size_t count) {
    return static_cast<T*>(::operator new(count * sizeof(T), std::align_val_t(kCacheLine)));
  }
  void deallocate(T* array, size_t) { ::operator delete(array, std::align_val_t(kCacheLine)); }
  friend bool operator==(LineAllocator, LineAllocator) { return true; }
};

template <class T>
using AlignedVector = std::vector<T, LineAllocator<T>>;

// `count` rows; row r starts at first + r * stride. Kernels take them by reference: copies are read
// in larger pieces than they were written in, which stalls the processor.
template <class T>
struct Rows {
  T* first = nullptr;
  size_t count = 0, stride = 0;

  T* row(size_t r) const { return first + r * stride; }
  // The same rows without their first `skip` numbers.
  Rows from(size_t skip) const { return {first + skip, count, stride}; }
  operator Rows<const T>() const requires(!std::is_const_v<T>) { return {first, count, stride}; }
};

// The best number of characters per kernel call; more are split into several calls.
inline constexpr size_t kRowsAtOnce = 8;
// Where speed matters, matrices have rows of a multiple of this many outputs, the lanes of the
// longest vector, so that kernels have no remainder.
inline constexpr size_t kPadding = 16;
constexpr size_t padded(size_t outputs) { return (outputs + kPadding - 1) / kPadding * kPadding; }

}  // namespace panache
