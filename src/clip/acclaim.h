#pragma once
// The Acclaim formats: a skeleton (.asf) and a motion of it (.amc), as CMU publishes its motions.
//
// Conventions: a bone turns about the end of its parent's. With C the rotation of its `axis` and R
// that of its degrees of freedom, applied in their order (rx before ry before rz), its rotation
// relative to the parent is C R C^-1, all in the axes of the skeleton; so the rest rotations of the
// joints are the identity. Units and axes are the file's own. Limits are not applied.

#include <memory>
#include <string>

#include "base/result.h"
#include "clip/clip.h"
#include "clip/motion_file.h"

namespace panache {

// The rate, which an .amc does not state. Most of CMU's are 120 frames a second.
inline constexpr double kAmcFrameRate = 120;

// The skeleton of an .asf at rest, its joints named as its bones, with an end at each bone that has
// no other below it. `name` stands in front of the message of a failure, followed by line and
// column.
Result<Skeleton> parse_asf(const std::string& text, const std::string& name);

// Reads an .amc. Its skeleton is the .asf beside it (`path` is where): "05.asf" for "05_10.amc",
// else one of its own name, else the only one in the folder. A bone that a frame leaves out keeps
// what it had. The motion is kept as a BVH file, which is what encode() gives.
Result<std::unique_ptr<MotionFile>> parse_amc(std::string text, const std::string& path,
                                              const ReadOptions& options = {});

}  // namespace panache
