#pragma once
// Rounding to integer steps, shared by the plain and the vectorised kernel of dense_int8.h.

#include <bit>
#include <cstdint>

#include "net/dense_int8.h"

namespace panache::int8_rounding {

inline constexpr uint32_t kSizeBits = 0x7fffffff;  // All bits but the sign.
inline constexpr uint32_t kLargestFinite = 0x7f7fffff;
inline constexpr int kMantissaBits = 23, kExponentBias = 127;
// 1.5 * 2^23, and its bits. Adding it rounds to the nearest integer (ties to even), which is the
// difference between the bits of the sum and these.
inline constexpr float kRound = 12582912.0f;
inline constexpr uint32_t kRoundBits = 0x4b400000;
// Numbers below 2^-87 would need steps below 2^-100: they count as 0.
inline constexpr int kSmallestExponent = kExponentBias - 87;

struct Step {
  float size, reciprocal;
};
// The step for a row whose largest finite magnitude has these bits.
inline Step step_for(uint32_t largest) {
  const int exponent = static_cast<int>(largest >> kMantissaBits);
  if (exponent < kSmallestExponent) return {0, 0};
  // The largest is below 2^(exponent + 1): 2^kInputBits steps of this reach it.
  const int step = exponent + 1 - kInputBits;
  const auto power = [](int biased) {
    return std::bit_cast<float>(static_cast<uint32_t>(biased) << kMantissaBits);
  };
  return {power(step), power(2 * kExponentBias - step)};
}

}  // namespace panache::int8_rounding
