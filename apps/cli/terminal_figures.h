#pragma once
// Draws motion as figures in a terminal.

#include <string>

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache::cli {

// Draws six evenly spaced instants from first to last frame: stick figures facing right on the
// floor, in Braille characters (UTF-8), above a line with their times. 72 columns; lines end with
// "\n". An instant that is not finite repeats the previous one.
std::string draw_figures(const Clip& clip, const Rig& rig);

}  // namespace panache::cli
