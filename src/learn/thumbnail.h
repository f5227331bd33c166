#pragma once
// A picture of a style, small enough to store in its file.

#include <span>
#include <string>

#include "learn/take.h"

namespace panache {

// A row of stick figures as an SVG file in one line, of less than 6 KB for six figures. `bodies`:
// in the body frame, metres. The body's right is drawn dark, its left light.
std::string draw_thumbnail(std::span<const HumanPositions> bodies);

// Six instants of the middle 1.5 seconds of a take, or the single one of a pose.
std::string thumbnail_of(const Take& take);

}  // namespace panache
