#pragma once
// Counts every allocation of the test program. Include it in one source file of a program only.

#include <cstdlib>
#include <new>

#include "allocations.h"

// GCC takes the replaced pair for a mismatched one where it sees only half of it inlined.
#if defined(__GNUC__) && !defined(__clang__)
#pragma GCC diagnostic ignored "-Wmismatched-new-delete"
#endif

void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  ++panache::test::allocations;
  panache::test::allocated_bytes += size;
  return std::malloc(size);
}
void* operator new(std::size_t size) {
  if (void* memory = operator new(size, std::nothrow)) return memory;
  throw std::bad_alloc();
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
void operator delete(void* memory, const std::nothrow_t&) noexcept { std::free(memory); }
