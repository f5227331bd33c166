#pragma once
// Drawings as pixels.

#include <string>

#include "base/result.h"

namespace panache::cli {

// The PNG of an SVG drawing, two pixels for each of the drawing's, or fewer where a side would have
// more than 32,000. `path` stands in front of the message of a failure. It is drawn in a process of
// its own: where the libraries that draw find no memory, they end it, or wait for ever.
Result<std::string> svg_to_png(const std::string& svg, const std::string& path);

// The first argument that makes this program the process that draws what stands at its standard
// input, and what it does then, with the path as the second; returns the exit code. Nobody else has
// a use for it.
inline constexpr const char* kPngDrawer = "--draw-png-for-parent";
int draw_png_as_child(const std::string& path);

}  // namespace panache::cli
