#pragma once
// Motion as figures in a terminal.

#include <string>

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache::cli {

// Six instants of the motion, evenly spread from its first to its last frame: stick figures on the
// floor that face right, drawn with the dots of Braille characters (UTF-8), above a line with their
// times. 72 columns; lines end with "\n". An instant that is not finite repeats the one before it.
std::string draw_figures(const Clip& clip, const Rig& rig);

}  // namespace panache::cli
