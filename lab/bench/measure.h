#pragma once
// Timing: one clock, histograms that do not allocate, and contestants that take turns.

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace panache::bench {

// Called regularly with 0 to 1; may be empty.
using ProgressCall = std::function<void(double)>;

// Nanoseconds of the monotonic clock.
inline int64_t now_ns() noexcept {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
}
// CPU time of this thread, nanoseconds, without the time that other programs take on the core. Ten
// times as expensive to read.
int64_t computed_ns() noexcept;
// The difference of two consecutive calls of now_ns(), nanoseconds, by which every measured time is
// too long. Measured once.
double clock_cost_ns();

// Pins the process, including threads started later, to its current core; returns whether the
// system allowed it. Then requests the highest priority, which only root gets, so that other
// programs that want the core are not measured too.
bool pin_to_one_core() noexcept;

// Evicts everything from this core's L1 and L2 caches by walking over a buffer four times the size
// of L2.
void evict_caches() noexcept;
// L2 size of this core as the system reports it; 2 MB if unknown.
size_t second_cache_bytes() noexcept;

// The quantile `at`, 0 to 1, of at least one value.
double quantile(std::vector<double> values, double at);

// A histogram of times, with buckets narrower than one percent. Adding does not allocate.
class Histogram {
 public:
  void add(int64_t ns) noexcept;
  int64_t count() const { return count_; }
  // The quantile `at`, 0 to 1, nanoseconds; 0 if empty.
  double quantile(double at) const noexcept;
  int64_t worst() const { return worst_; }  // Exact, nanoseconds.

 private:
  static constexpr int kBits = 7;  // Buckets per doubling: 2^7.
  static constexpr int kBuckets = (64 - kBits) << kBits;
  static int bucket(int64_t ns) noexcept;
  static double middle(int bucket) noexcept;

  std::array<uint32_t, kBuckets> buckets_{};
  int64_t count_ = 0, worst_ = 0;
};

struct Contestant {
  std::string name;
  std::function<void()> run;
};

// Microseconds of one call.
struct Timing {
  double warm = 0;           // Median over the rounds, with repeated calls;
  double low = 0, high = 0;  // the 10 % and 90 % quantiles of the rounds.
  double cold = 0;           // Median of single calls after evict_caches().
};

// Times all contestants in rounds in which they take turns, so that other load on the machine
// affects all alike. In a round, each is called a few times untimed and then repeatedly for a fifth
// of a millisecond; the round's time is the mean of these calls. One Timing per contestant.
std::vector<Timing> race(std::span<const Contestant> contestants, int rounds,
                         const ProgressCall& progress = {});

// The peak performance of the machine with its widest registers, to compare network speed with.
struct Limits {
  std::string processor;    // Name given by the system.
  double memory_gb_s = 0;   // Reading far more memory than any cache holds.
  double apart_gflops = 0;  // Separate multiply and add in registers, as our kernels do,
  double fused_gflops = 0;  // and fused if the machine can; 10^9 operations a second.
};
Limits measure_limits();

}  // namespace panache::bench
