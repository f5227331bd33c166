#pragma once
// What count_allocations.h counts, in the test programs that include it.

#include <atomic>
#include <cstddef>

namespace panache::test {
inline std::atomic<long> allocations = 0;
inline std::atomic<size_t> allocated_bytes = 0;  // All that was ever asked for.
}  // namespace panache::test
