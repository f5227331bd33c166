#pragma once

#include <algorithm>

namespace panache {

// Rises from 0 to 1 with `x`, with zero slope at both ends; constant beyond them.
inline float smooth_step(float x) noexcept {
  x = std::clamp(x, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}

}  // namespace panache
