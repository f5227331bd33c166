#pragma once
// The shape of a style as the library has it.

#include "base/result.h"
#include "panache/panache.h"
#include "style/shape.h"

namespace panache::api {

// Null: all of it at 1.
Result<Shape> read_shape(const panache_shape* given);

}  // namespace panache::api
