#pragma once
// Arrays aligned to cache lines, so that no SIMD vector crosses two lines.

#include <cstddef>
#include <new>
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

}  // namespace panache
