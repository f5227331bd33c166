#pragma once
// Measures elapsed time.

#include <chrono>

namespace panache {

class Stopwatch {
 public:
  // Since construction.
  double seconds() const { return std::chrono::duration<double>(Clock::now() - begin_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point begin_ = Clock::now();
};

}  // namespace panache
