#pragma once
// Notes about a motion file, for the user.

#include <string>
#include <vector>

#include "clip/motion_file.h"

namespace panache {

// MotionFile::notes(), motions that are skipped because they move no joint of the humanoid, and
// motions whose steps contradict their rate: one message each, starting with `path`.
std::vector<std::string> motion_notes(const MotionFile& file, const std::string& path);

}  // namespace panache
