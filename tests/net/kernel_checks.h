#pragma once
// How kernels are compared with the plain loops that define them.

#include <bit>
#include <cmath>
#include <cstdint>
#include <random>
#include <set>
#include <span>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include "net/dense.h"

namespace panache::test {

inline constexpr unsigned kSeed = 20190713;
inline constexpr float kUntouched = 12345.0f;

inline std::vector<float> random_numbers(size_t count, std::mt19937& random) {
  std::normal_distribution<float> normal(0, 1.5f);
  std::vector<float> numbers(count);
  for (float& v : numbers) v = normal(random);
  return numbers;
}

// Any NaN equals any other; all else must agree in each bit, the sign of zero included.
inline ::testing::AssertionResult same_bits(std::span<const float> a, std::span<const float> b) {
  for (size_t i = 0; i < a.size(); ++i) {
    if (std::isnan(a[i]) && std::isnan(b[i])) continue;
    if (std::bit_cast<uint32_t>(a[i]) != std::bit_cast<uint32_t>(b[i])) {
      return ::testing::AssertionFailure() << "number " << i << " of " << a.size() << " is " << a[i]
                                           << ", by the plain loop " << b[i];
    }
  }
  return ::testing::AssertionSuccess();
}

// Runs `check` on every instruction set that this machine has and the kernels are compiled for.
template <class Check>
void on_every_target(Check check) {
#ifdef HWY_COMPILE_ONLY_STATIC  // The one that was chosen by the compiler.
  SCOPED_TRACE(std::string("on ") + kernel_target() + ", seed " + std::to_string(kSeed));
  check();
#else
  const int64_t supported = hwy::SupportedTargets();
  std::set<std::string> seen;
  for (int64_t rest = supported; rest != 0; rest &= rest - 1) {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    // Targets that are not compiled fall back to one that is.
    if (!seen.insert(kernel_target()).second) continue;
    SCOPED_TRACE(std::string("on ") + kernel_target() + ", seed " + std::to_string(kSeed));
    check();
  }
  hwy::SetSupportedTargetsForTest(0);
#if defined(__x86_64__)
  EXPECT_GE(seen.size(), 3u) << "expected at least SSSE3, SSE4 and the portable fallback";
#endif
#endif
}

}  // namespace panache::test
