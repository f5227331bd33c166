#pragma once
// The same work for many items, over all cores.

#include <atomic>
#include <functional>
#include <thread>
#include <vector>

namespace panache {

// Calls work(i) for each i in [0, count) from as many threads as there are cores (or `threads`).
// Items are handed out in order; work must not throw.
inline void parallel_for(int count, const std::function<void(int)>& work, int threads = 0) {
  if (threads <= 0) threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  std::atomic<int> next = 0;
  const auto run = [&] {
    for (int i; (i = next.fetch_add(1)) < count;) work(i);
  };
  std::vector<std::thread> others;
  for (int t = 1; t < std::min(threads, count); ++t) others.emplace_back(run);
  run();
  for (std::thread& thread : others) thread.join();
}

}  // namespace panache
