#pragma once
// Constants of our own exp(x) - 1 for x <= 0, shared by the plain and the vectorised kernel.
//
// With n = round(x / ln 2) and r = x - n ln 2, |r| <= ln(2) / 2:
//   exp(x) - 1 = 2^n exp(r) - 1 = 2^n (exp(r) - 1) + (2^n - 1),
// which keeps small x exact, because there n = 0 and exp(r) - 1 comes straight from its series
//   r + r^2 (1/2! + r/3! + ... + r^5/7!).
// The truncation error of the series is below r^8/8! < 6e-9, a tenth of float's unit at 1.

#include <cstdint>

namespace panache::exponential {

// exp(-30) is far below half a unit of 1: from here on the result is -1, and 2^n stays normal.
inline constexpr float kLowest = -30.0f;
inline constexpr float kLog2E = 1.44269504f;
// 1.5 * 2^23. Adding it rounds to the nearest whole number (even on a tie), which is then found in
// the low bits of the sum; subtracting it again gives that number as a float.
inline constexpr float kRound = 12582912.0f;
// ln 2 in two parts; the first has so few bits that n times it is exact.
inline constexpr float kLn2High = 0.693359375f;
inline constexpr float kLn2Low = -2.12194440e-4f;
inline constexpr float kSeries[6] = {1.0f / 2,   1.0f / 6,   1.0f / 24,
                                     1.0f / 120, 1.0f / 720, 1.0f / 5040};
inline constexpr int kMantissaBits = 23;
inline constexpr uint32_t kOneBits = 0x3f800000;  // 1.0f

}  // namespace panache::exponential
