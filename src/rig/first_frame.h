#pragma once
// Detects whether a clip's first frame belongs to its motion. Private to the folder.

#include <string>
#include <vector>

#include "clip/clip.h"

namespace panache {

// 0, or 1 if frame 0 is a calibration pose, with a note added to `notes`.
int find_first_frame(const Clip& clip, std::vector<std::string>& notes);

}  // namespace panache
