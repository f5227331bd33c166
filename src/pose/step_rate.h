#pragma once
// Whether a motion walks as fast as legs of its length can.

#include <optional>
#include <string>

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

// The fault of the rate of a clip of `rig`'s skeleton, as a message without the file's name:
// its steps are far too fast or far too slow for the length of its legs. Nothing where they are
// not, or where it takes too few steps to tell.
std::optional<std::string> doubtful_rate(const Clip& clip, const Rig& rig);

}  // namespace panache
