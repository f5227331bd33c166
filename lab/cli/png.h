#pragma once
// Renders drawings to pixels.

#include <string>

#include "base/result.h"

namespace panache::cli {

// Renders an SVG drawing to PNG at two pixels per unit, or fewer if a side would exceed 32,000.
// `path` is the prefix of messages. Runs in a separate process, because the drawing libraries abort
// or hang when out of memory.
Result<std::string> svg_to_png(const std::string& svg, const std::string& path);

// The first argument that turns this program into that process, and its main function: it draws
// standard input, with the path as the second argument, and returns the exit code. For internal use
// only.
inline constexpr const char* kPngDrawer = "--draw-png-for-parent";
int draw_png_as_child(const std::string& path);

}  // namespace panache::cli
