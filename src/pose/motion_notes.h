#pragma once
// Notes about a motion file, for the user.

#include <string>
#include <vector>

#include "clip/motion_file.h"

namespace panache {

// MotionFile::notes(), which motions move no joint of the humanoid and are passed over, and whose
// steps speak against their rate: one sentence each, with `path` in front.
std::vector<std::string> motion_notes(const MotionFile& file, const std::string& path);

}  // namespace panache
