#pragma once
// The Acclaim formats: a skeleton (.asf) and a motion for it (.amc), as used by CMU.
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

// The skeleton of an .asf at rest. Joints have the names of the bones; each bone without children
// gets an end. Error messages start with `name`, line and column.
Result<Skeleton> parse_asf(const std::string& text, const std::string& name);

// Reads an .amc. Its skeleton is an .asf in the folder of `path`: "05.asf" for "05_10.amc", else
// one with the .amc's own name, else the only one there. A bone that a frame omits keeps its
// values. The motion is kept as a BVH file, which is what encode() returns.
Result<std::unique_ptr<MotionFile>> parse_amc(std::string text, const std::string& path,
                                              const ReadOptions& options = {});

}  // namespace panache
