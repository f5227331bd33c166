#pragma once

#include <algorithm>

namespace panache {

// From 0 to 1 as `x` goes from 0 to 1, level at both ends; held beyond them.
inline float smooth_step(float x) noexcept {
  x = std::clamp(x, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

}  // namespace panache
