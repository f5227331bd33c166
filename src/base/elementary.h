#pragma once
// Elementary functions of float that give the same bits on every machine and in the browser, unlike
// those of the system library. They sum series in double, to about 1e-9; rounding to float leaves
// an error of at most one unit in the last place.
//
// The functions of double are the system's; nothing with guaranteed bits uses them.

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace panache {

namespace elementary {

inline constexpr double kHalfPi = 1.57079632679489661923;
inline constexpr double kQuartersPerRadian = 0.63661977236758134308;
inline constexpr double kLn2 = 0.69314718055994530942, kLog2E = 1.44269504088896340736;
// 1.5 * 2^52: adding it rounds to an integer, which is then in the low bits of the sum.
inline constexpr double kRound = 6755399441055744.0;

// Taylor series; for |r| <= pi / 4 the error is below r^13 / 13! = 7e-12.
inline double sine_near_zero(double r) {
  const double s = r * r;
  return r *
         (1 + s * (-1.0 / 6 + s * (1.0 / 120 + s * (-1.0 / 5040 +
                                                    s * (1.0 / 362880 + s * (-1.0 / 39916800))))));
}
// The error is below r^14 / 14! = 4e-13.
inline double cosine_near_zero(double r) {
  const double s = r * r;
  return 1 +
         s * (-1.0 / 2 +
              s * (1.0 / 24 + s * (-1.0 / 720 + s * (1.0 / 40320 + s * (-1.0 / 3628800 +
                                                                        s * (1.0 / 479001600))))));
}

// The sine of `x` plus `quarters` quarter turns.
inline float sine(double x, uint64_t quarters) {
  // Beyond this, neighbouring floats are more than a turn apart.
  if (!(std::abs(x) < 1e8)) return std::isfinite(x) ? 0.0f : std::nanf("");
  const double shifted = x * kQuartersPerRadian + kRound;
  const double r = x - (shifted - kRound) * kHalfPi;
  const uint64_t quarter = (std::bit_cast<uint64_t>(shifted) + quarters) & 3;
  const double part = quarter & 1 ? cosine_near_zero(r) : sine_near_zero(r);
  return static_cast<float>(quarter & 2 ? -part : part);
}

// The arc tangent of `t`, |t| <= sqrt(2) - 1; the error of the series is below t^25 / 25 = 1e-11.
inline double arc_tangent_near_zero(double t) {
  const double s = t * t;
  double sum = 0;
  for (int k = 23; k >= 3; k -= 2) sum = s * (((k & 2) != 0 ? -1.0 : 1.0) / k + sum);
  return t * (1 + sum);
}

}  // namespace elementary

inline float sine(float x) { return elementary::sine(static_cast<double>(x), 0); }
inline float cosine(float x) { return elementary::sine(static_cast<double>(x), 1); }

// The angle from the x axis to the point (x, y), in [-pi, pi]; 0 where both are 0.
inline float arc_tangent(float y, float x) {
  using namespace elementary;
  if (std::isnan(x) || std::isnan(y)) return std::nanf("");
  const double across = std::abs(static_cast<double>(y)), along = std::abs(static_cast<double>(x));
  const double larger = across > along ? across : along;
  if (larger == 0) return 0;
  if (!std::isfinite(larger))
    return arc_tangent(std::copysign(std::isinf(y) ? 1.0f : 0.0f, y),
                       std::isinf(x) ? std::copysign(1.0f, x) : 0.0f);
  const double t = (across > along ? along : across) / larger;
  // Beyond a quarter of a right angle, tan(a - pi/4) = (tan(a) - 1) / (tan(a) + 1).
  double angle = t > 0.41421356 ? kHalfPi / 2 + arc_tangent_near_zero((t - 1) / (t + 1))
                                : arc_tangent_near_zero(t);
  if (across > along) angle = kHalfPi - angle;
  if (x < 0) angle = 2 * kHalfPi - angle;
  return static_cast<float>(std::signbit(y) ? -angle : angle);
}

// e to the power of `x`.
inline float exponential(float x) {
  using namespace elementary;
  // Outside this range a float is 0 or infinite.
  const double value = x < -110.0f ? -110.0 : x > 90.0f ? 90.0 : static_cast<double>(x);
  if (std::isnan(value)) return x;
  const double shifted = value * kLog2E + kRound;
  const double r = value - (shifted - kRound) * kLn2;
  // Taylor series; for |r| <= ln(2) / 2 the error is below r^10 / 10! = 7e-12.
  constexpr double kInverse[] = {1.0,     1.0 / 2, 1.0 / 3, 1.0 / 4, 1.0 / 5,
                                 1.0 / 6, 1.0 / 7, 1.0 / 8, 1.0 / 9};
  double sum = 1;
  for (int k = 8; k >= 0; --k) sum = 1 + sum * r * kInverse[k];
  constexpr int kMantissaBits = 52;
  constexpr uint64_t kOneBits = 0x3ff0000000000000;
  const uint64_t whole = std::bit_cast<uint64_t>(shifted) - std::bit_cast<uint64_t>(kRound);
  return static_cast<float>(sum * std::bit_cast<double>((whole << kMantissaBits) + kOneBits));
}

inline double sine(double x) { return std::sin(x); }
inline double cosine(double x) { return std::cos(x); }
inline double arc_tangent(double y, double x) { return std::atan2(y, x); }

// Ways from one value to another: a smooth step, a list of values, a first-order filter.

// Rises from 0 to 1 with `x`, with zero slope at both ends; constant beyond them.
inline float smooth_step(float x) noexcept {
  x = std::clamp(x, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

// The value at the fractional index `at` of a non-empty list, linearly interpolated; clamped to the
// first and last value.
inline double between(const std::vector<double>& list, double at) {
  const size_t a = std::min(static_cast<size_t>(std::max(at, 0.0)), list.size() - 1);
  const size_t b = std::min(a + 1, list.size() - 1);
  return std::lerp(list[a], list[b], at - static_cast<double>(a));
}

// The fraction of the distance to its target that a filter covers in `seconds`.
inline float filter_gain(float seconds, float time_constant) noexcept {
  return time_constant > 0 ? 1 - exponential(-seconds / time_constant) : 1.0f;
}

// Moves by the fraction `gain` towards `target`; within `near` of it, all the way.
inline void approach(float& value, float target, float gain, float near) noexcept {
  value += gain * (target - value);
  if (std::abs(target - value) < near) value = target;
}

}  // namespace panache
