#pragma once
// Drawings as pixels.

#include <string>

#include "base/result.h"

namespace panache::cli {

// The PNG of an SVG drawing, two pixels for each of the drawing's. `path` stands in front of the
// message of a failure.
Result<std::string> svg_to_png(const std::string& svg, const std::string& path);

}  // namespace panache::cli
