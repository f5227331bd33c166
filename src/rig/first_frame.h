#pragma once
// Whether a clip's first frame belongs to its motion. Private to the folder.

#include <string>
#include <vector>

#include "clip/clip.h"

namespace panache {

// 0, or 1 where frame 0 is a calibration pose; the note that says so is added to `notes`.
int find_first_frame(const Clip& clip, std::vector<std::string>& notes);

}  // namespace panache
