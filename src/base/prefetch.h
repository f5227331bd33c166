#pragma once
// Prefetches memory that is needed soon.

#include <array>
#include <cassert>
#include <cstddef>
#include <span>

namespace panache {

inline constexpr size_t kPrefetchLine = 64;  // Bytes.

// Prefetches for reading, all at once.
inline void prefetch(const void* first, size_t bytes) noexcept {
  for (size_t i = 0; i < bytes; i += kPrefetchLine) {
    __builtin_prefetch(static_cast<const char*>(first) + i);
  }
}

// Prefetches memory that is read and written some microseconds later, a few lines at a time, into
// the L2 cache: a processor has only some 16 requests in flight, and more would stall other work.
class Prefetch {
 public:
  void add(const void* first, size_t bytes) noexcept {
    assert(count_ < kMaxRanges);
    ranges_[count_++] = {static_cast<const char*>(first), bytes};
  }
  template <class T>
  void add(std::span<T> numbers) noexcept {
    add(numbers.data(), numbers.size_bytes());
  }
  // Prefetches up to `lines` more lines.
  void fetch(int lines) noexcept {
    for (; lines > 0 && now_ < count_; --lines) {
      const Range& range = ranges_[now_];
      if (done_ < range.bytes) __builtin_prefetch(range.first + done_, 1, 2);
      done_ += kPrefetchLine;
      if (done_ < range.bytes) continue;
      done_ = 0;
      ++now_;
    }
  }

 private:
  struct Range {
    const char* first;
    size_t bytes;
  };
  static constexpr size_t kMaxRanges = 12;
  std::array<Range, kMaxRanges> ranges_;
  size_t count_ = 0, now_ = 0, done_ = 0;  // Bytes of the range `now_`.
};

}  // namespace panache
