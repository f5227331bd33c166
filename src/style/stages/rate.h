#pragma once
// The range of a style's tempo.

#include <algorithm>

namespace panache {

// Half to double tempo, as the logarithm of input seconds per output second.
inline constexpr float kMaxLogRate = 0.7f;

inline float bounded_log_rate(float log_rate) noexcept {
  return std::clamp(log_rate, -kMaxLogRate, kMaxLogRate);
}

}  // namespace panache
