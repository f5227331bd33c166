#pragma once
// Detects a wrong frame rate from the speed of a motion's steps, and notes it for the user.

#include <optional>
#include <string>
#include <vector>

#include "clip/clip.h"
#include "clip/motion_file.h"
#include "rig/rig.h"

namespace panache {

// The fault of the rate of a clip of `rig`'s skeleton, as a message without the file's name: its
// steps are far too fast or far too slow for the length of its legs. Nothing if they are plausible,
// or if there are too few steps.
std::optional<std::string> doubtful_rate(const Clip& clip, const Rig& rig);

// MotionFile::notes(), motions that are skipped because they move no joint of the humanoid, and
// motions whose steps contradict their rate: one message each, starting with `path`.
std::vector<std::string> motion_notes(const MotionFile& file, const std::string& path);

}  // namespace panache
