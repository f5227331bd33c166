#include "bench/measure.h"

#include <algorithm>
#include <fstream>
#include <vector>

#include "net/dense.h"

// Running sums are kept in arrays, because vectors of unknown length cannot be.
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)

// From here on this file is compiled once per instruction set.
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "bench/machine.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"

HWY_BEFORE_NAMESPACE();
namespace panache::bench {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Floats = hn::ScalableTag<float>;
using Vector = hn::Vec<Floats>;

// Enough running sums to hide the latency of an addition.
constexpr size_t kArithmeticSums = 12;

template <bool kFused>
float arithmetic(size_t rounds) {
  const Floats d;
  const Vector factor = hn::Set(d, 0.999f), step = hn::Set(d, 0.001f);
  Vector sums[kArithmeticSums];
  for (size_t s = 0; s < kArithmeticSums; ++s) sums[s] = hn::Set(d, static_cast<float>(s));
  for (size_t r = 0; r < rounds; ++r) {
    for (Vector& sum : sums) {
      sum = kFused ? hn::MulAdd(sum, factor, step) : hn::Add(hn::Mul(sum, factor), step);
    }
  }
  for (size_t s = 1; s < kArithmeticSums; ++s) sums[0] = hn::Add(sums[0], sums[s]);
  return hn::GetLane(hn::SumOfLanes(d, sums[0]));
}

float multiply_and_add(size_t rounds) { return arithmetic<false>(rounds); }
float fused_multiply_add(size_t rounds) { return arithmetic<true>(rounds); }
// Operations per round of either loop.
size_t operations() { return 2 * kArithmeticSums * hn::Lanes(Floats()); }

}  // namespace HWY_NAMESPACE
}  // namespace panache::bench
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace panache::bench {

HWY_EXPORT(multiply_and_add);
HWY_EXPORT(fused_multiply_add);
HWY_EXPORT(operations);

namespace {

// Keeps compilers from removing unused results.
volatile float unused;

constexpr int kRepeats = 15;

// Median duration of `work`, seconds.
template <class Work>
double seconds_of(const Work& work) {
  std::vector<double> times;
  for (int i = 0; i < kRepeats; ++i) {
    const int64_t begin = now_ns();
    unused = work();
    times.push_back(std::max(1e-9, static_cast<double>(now_ns() - begin) * 1e-9));
  }
  return quantile(times, 0.5);
}

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);) {
    const size_t colon = line.find(": ");
    if (line.starts_with("model name") && colon != line.npos) return line.substr(colon + 2);
  }
  return "unknown processor";
}

}  // namespace

Limits measure_limits() {
  Limits limits;
  limits.processor = processor_name();
  constexpr size_t kRounds = 50'000;
  const double operations =
      1e-9 * kRounds * static_cast<double>(HWY_DYNAMIC_DISPATCH(operations)());
  limits.apart_gflops =
      operations / seconds_of([] { return HWY_DYNAMIC_DISPATCH(multiply_and_add)(kRounds); });
  limits.fused_gflops =
      operations / seconds_of([] { return HWY_DYNAMIC_DISPATCH(fused_multiply_add)(kRounds); });
  // More than twice the size of the largest L3 caches.
  const std::vector<float> numbers(size_t{64} << 20, 1.0f);
  limits.memory_gb_s = 1e-9 * sizeof(float) * static_cast<double>(numbers.size()) /
                       seconds_of([&] { return sum_in_any_order(numbers); });
  return limits;
}

}  // namespace panache::bench
#endif  // HWY_ONCE
