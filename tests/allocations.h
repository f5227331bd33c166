#pragma once
// What count_allocations.h counts and allows, in the test programs that include it.

#include <atomic>
#include <climits>
#include <cstddef>
#include <new>

namespace panache::test {

inline std::atomic<long> allocations = 0;
inline std::atomic<size_t> allocated_bytes = 0;  // All that was ever asked for.

// How many more succeed, and what becomes of the others.
inline std::atomic<long> allocations_left = LONG_MAX;
inline std::atomic<void (*)()> out_of_memory{+[] { throw std::bad_alloc(); }};

}  // namespace panache::test
