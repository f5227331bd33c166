#pragma once
// Arrays that begin on a cache line, so that no vector of theirs lies across two.

#include <cstddef>
#include <new>
#include <vector>

namespace panache {

inline constexpr size_t kCacheLine = 64;  // Bytes; the longest vector of any instruction set too.

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
