#pragma once
// How time is taken: one clock, counts without allocation, contestants that take turns.

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace panache::bench {

// Called with 0 to 1 now and then; may be empty.
using ProgressCall = std::function<void(double)>;

// Nanoseconds of the monotonic clock.
inline int64_t now_ns() noexcept {
  using namespace std::chrono;
  return duration_cast<nanoseconds>(steady_clock::now().time_since_epoch()).count();
}
// Nanoseconds that this thread has computed for: what other programs take of the core in between is
// not in it. Costs ten times as much to look at.
int64_t computed_ns() noexcept;
// What two calls of now_ns() show of each other where nothing is between them, nanoseconds: what
// any time taken with them is too long by. Measured once.
double clock_cost_ns();

// Ties the process to the core that it runs on, the threads that it starts later too; returns
// whether the system allowed that. Then asks for the highest priority, which only root gets: other
// programs that want the core would else be measured with ours.
bool pin_to_one_core() noexcept;

// Pushes everything else out of the first and second cache of this core: walks over a buffer of
// four times the second one.
void evict_caches() noexcept;
// Of this core, as the system tells; a guess of 2 MB where it does not.
size_t second_cache_bytes() noexcept;

// The value below which the share `at`, 0 to 1, of the values lie. At least one value.
double quantile(std::vector<double> values, double at);

// How often which time was seen, in buckets of less than one percent of the time. Adding allocates
// nothing.
class Histogram {
 public:
  void add(int64_t ns) noexcept;
  int64_t count() const { return count_; }
  // The time that the share `at`, 0 to 1, does not exceed, nanoseconds; 0 where nothing was added.
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
  double warm = 0;           // Median over the rounds, called again and again;
  double low = 0, high = 0;  // what a tenth of the rounds stay below, and nine tenths.
  double cold = 0;           // Median of single calls after evict_caches().
};

// Times all contestants in rounds, taking turns, so that whatever else the machine does meets each
// of them alike. In a round each is called a few times unseen, and then so often that a fifth of a
// millisecond goes by; the round's time is the mean of these calls. One Timing per contestant.
std::vector<Timing> race(std::span<const Contestant> contestants, int rounds,
                         const ProgressCall& progress = {});

}  // namespace panache::bench
