#pragma once
// Detects a wrong frame rate from the speed of a motion's steps.

#include <optional>
#include <string>

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

// The fault of the rate of a clip of `rig`'s skeleton, as a message without the file's name: its
// steps are far too fast or far too slow for the length of its legs. Nothing if they are plausible,
// or if there are too few steps.
std::optional<std::string> doubtful_rate(const Clip& clip, const Rig& rig);

}  // namespace panache
