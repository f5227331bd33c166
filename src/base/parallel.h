#pragma once
// Parallel loops over many items.

#include <algorithm>
#include <atomic>
#include <exception>
#include <functional>
#include <optional>
#include <thread>
#include <vector>

#include "base/result.h"

namespace panache {

// Calls work(i) for each i in [0, count) on as many threads as there are cores, or on `threads`; 1
// means the caller's thread only. Items start in order. If threads cannot be started, the remaining
// ones do the work, at least the caller's. If work(i) throws, no further item starts and the caller
// gets the first exception. WebAssembly has no threads: the caller does it all.
inline void parallel_for(int count, const std::function<void(int)>& work, int threads = 0) {
#if defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
  static_cast<void>(threads);
  for (int i = 0; i < count; ++i) work(i);
#else
  if (threads <= 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::atomic<int> next = 0;
  std::atomic_flag failed;
  std::exception_ptr first;
  const auto run = [&]() noexcept {
    try {
      for (int i; (i = next.fetch_add(1)) < count;) work(i);
    } catch (...) {
      next = count;
      if (!failed.test_and_set()) first = std::current_exception();
    }
  };
  std::vector<std::thread> others;
  try {
    for (int t = 1; t < std::min(threads, count); ++t) others.emplace_back(run);
  } catch (...) {
    // No further thread, or no memory to hold it.
  }
  run();
  for (std::thread& thread : others) thread.join();
  if (first) std::rethrow_exception(first);
#endif
}

// What make(i), a Result<T>, gives for each i in [0, count), made as by parallel_for(); or the
// first error in order.
template <class T, class Make>
Result<std::vector<T>> parallel_results(size_t count, const Make& make) {
  std::vector<std::optional<Result<T>>> made(count);
  parallel_for(static_cast<int>(count), [&](int i) { made[static_cast<size_t>(i)] = make(i); });
  std::vector<T> out;
  out.reserve(count);
  for (std::optional<Result<T>>& one : made) {
    if (!*one) return one->error();
    out.push_back(*std::move(*one));
  }
  return out;
}

}  // namespace panache
