#pragma once
// Counts every allocation of the test program, whatever form of `new` it uses, and makes those fail
// that allocations.h does not allow. Include it in one source file of a program only.

#include <algorithm>
#include <cstdlib>
#include <new>

#include "allocations.h"

// GCC takes the replaced pair for a mismatched one where it sees only half of it inlined.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

namespace panache::test {

[[gnu::noinline]] inline void* allocate(std::size_t size, std::align_val_t alignment) {
  ++allocations;
  allocated_bytes += size;
  if (--allocations_left < 0) out_of_memory.load()();
  const auto unit = static_cast<std::size_t>(alignment);
  const std::size_t whole_units = (std::max<std::size_t>(size, 1) + unit - 1) / unit * unit;
  if (void* memory = std::aligned_alloc(unit, whole_units)) return memory;
  throw std::bad_alloc();
}

inline void* allocate_or_null(std::size_t size, std::align_val_t alignment) noexcept {
  try {
    return allocate(size, alignment);
  } catch (...) {
    return nullptr;
  }
}

inline constexpr std::align_val_t kUsualAlignment{__STDCPP_DEFAULT_NEW_ALIGNMENT__};

}  // namespace panache::test

// All forms, because those of the address sanitizer do not call each other as the library's do.
void* operator new(std::size_t size) {
  return panache::test::allocate(size, panache::test::kUsualAlignment);
}
void* operator new(std::size_t size, std::align_val_t alignment) {
  return panache::test::allocate(size, alignment);
}
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return panache::test::allocate_or_null(size, panache::test::kUsualAlignment);
}
void* operator new(std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return panache::test::allocate_or_null(size, alignment);
}
void* operator new[](std::size_t size) {
  return panache::test::allocate(size, panache::test::kUsualAlignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment) {
  return panache::test::allocate(size, alignment);
}
void* operator new[](std::size_t size, const std::nothrow_t&) noexcept {
  return panache::test::allocate_or_null(size, panache::test::kUsualAlignment);
}
void* operator new[](std::size_t size, std::align_val_t alignment, const std::nothrow_t&) noexcept {
  return panache::test::allocate_or_null(size, alignment);
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete(void* memory, std::align_val_t, const std::nothrow_t&) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, std::size_t, std::align_val_t) noexcept { std::free(memory); }
void operator delete[](void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
void operator delete[](void* memory, std::align_val_t, const std::nothrow_t&) noexcept {
  std::free(memory);
}
