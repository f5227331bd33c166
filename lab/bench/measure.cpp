#include "bench/measure.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>

#include <sched.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>

namespace panache::bench {
namespace {

constexpr double kBatchNs = 200e3;
constexpr int kMaxBatch = 2000;
constexpr int kUnseenCalls = 3;
constexpr size_t kLine = 64;  // Bytes per cache line.

double time_ns(const std::function<void()>& run, int calls) {
  const int64_t begin = now_ns();
  for (int i = 0; i < calls; ++i) run();
  return static_cast<double>(now_ns() - begin) / calls;
}

}  // namespace

int64_t computed_ns() noexcept {
  timespec time{};
  ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
  return int64_t{1'000'000'000} * time.tv_sec + time.tv_nsec;
}

double clock_cost_ns() {
  static const double cost = [] {
    std::vector<double> times;
    for (int i = 0; i < 2001; ++i) {
      const int64_t begin = now_ns();
      times.push_back(static_cast<double>(now_ns() - begin));
    }
    return quantile(times, 0.5);
  }();
  return cost;
}

bool pin_to_one_core() noexcept {
  constexpr int kHighest = -20;
  (void)::setpriority(PRIO_PROCESS, 0, kHighest);
  const int core = ::sched_getcpu();
  if (core < 0) return false;
  cpu_set_t cores;
  CPU_ZERO(&cores);
  CPU_SET(core, &cores);
  return ::sched_setaffinity(0, sizeof cores, &cores) == 0;
}

size_t second_cache_bytes() noexcept {
  const long given = ::sysconf(_SC_LEVEL2_CACHE_SIZE);
  return given > 0 ? static_cast<size_t>(given) : size_t{2} << 20;
}

void evict_caches() noexcept {
  static std::vector<char> buffer(4 * second_cache_bytes());
  // Writes, because modified lines need space of their own, which evicts other data.
  for (size_t i = 0; i < buffer.size(); i += kLine) {
    const_cast<volatile char&>(buffer[i]) = static_cast<char>(buffer[i] + 1);
  }
}

double quantile(std::vector<double> values, double at) {
  assert(!values.empty());
  const auto rank = static_cast<ptrdiff_t>(at * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), values.begin() + rank, values.end());
  return values[static_cast<size_t>(rank)];
}

int Histogram::bucket(int64_t ns) noexcept {
  const uint64_t value = static_cast<uint64_t>(std::max<int64_t>(ns, 0));
  const int dropped = std::max(0, static_cast<int>(std::bit_width(value)) - kBits - 1);
  return (dropped << kBits) + static_cast<int>(value >> dropped);
}

double Histogram::middle(int bucket) noexcept {
  const int dropped = std::max(0, (bucket >> kBits) - 1);
  const double low = std::ldexp(static_cast<double>(bucket - (dropped << kBits)), dropped);
  return dropped == 0 ? low : low + std::ldexp(0.5, dropped);
}

void Histogram::add(int64_t ns) noexcept {
  ++buckets_[static_cast<size_t>(bucket(ns))];
  ++count_;
  worst_ = std::max(worst_, ns);
}

double Histogram::quantile(double at) const noexcept {
  const auto wanted = static_cast<int64_t>(std::ceil(at * static_cast<double>(count_)));
  int64_t seen = 0;
  for (int b = 0; b < kBuckets; ++b) {
    seen += buckets_[static_cast<size_t>(b)];
    if (seen > 0 && seen >= wanted) return std::min(middle(b), static_cast<double>(worst_));
  }
  return 0;
}

std::vector<Timing> race(std::span<const Contestant> contestants, int rounds,
                         const ProgressCall& progress) {
  assert(rounds > 0);
  const size_t count = contestants.size();
  std::vector<int> batch(count);
  std::vector<std::vector<double>> warm(count), cold(count);
  for (size_t c = 0; c < count; ++c) {
    time_ns(contestants[c].run, kUnseenCalls);
    const double once = std::max(1.0, time_ns(contestants[c].run, kUnseenCalls));
    batch[c] = static_cast<int>(std::clamp(kBatchNs / once, 1.0, double{kMaxBatch}));
  }
  for (int round = 0; round < rounds; ++round) {
    for (size_t turn = 0; turn < count; ++turn) {
      // The first contestant changes every time, so that none always follows the same one.
      const size_t c = (turn + static_cast<size_t>(round)) % count;
      time_ns(contestants[c].run, kUnseenCalls);
      warm[c].push_back(time_ns(contestants[c].run, batch[c]));
      // Fewer cold calls: more add little precision, and evicting is slow.
      if (round % 4 != 0) continue;
      evict_caches();
      cold[c].push_back(std::max(0.0, time_ns(contestants[c].run, 1) - clock_cost_ns()));
    }
    if (progress) progress((round + 1.0) / rounds);
  }
  std::vector<Timing> timings(count);
  for (size_t c = 0; c < count; ++c) {
    timings[c] = {quantile(warm[c], 0.5) / 1e3, quantile(warm[c], 0.1) / 1e3,
                  quantile(warm[c], 0.9) / 1e3, quantile(cold[c], 0.5) / 1e3};
  }
  return timings;
}

}  // namespace panache::bench
