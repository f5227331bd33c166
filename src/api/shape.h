#pragma once
// Options of styling as the library has them.

#include <limits>

#include "base/result.h"
#include "panache/panache.h"
#include "style/shape.h"

namespace panache::api {

// Null: all of it at 1.
Result<Shape> read_shape(const panache_shape* given);

// Metres per second, where 0 is no limit.
inline float read_max_speed(double given) {
  return given == 0 ? std::numeric_limits<float>::infinity() : static_cast<float>(given);
}

}  // namespace panache::api
