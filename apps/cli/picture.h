#pragma once
// Pictures of the kinds that FBX files bring along and glTF does not hold.

#include <string>

#include "base/result.h"

namespace panache::cli {

// The PNG of a TGA, BMP, PSD, GIF, PNM or Radiance picture. It is read in a process of its own,
// which can only compute (child_process.h). The message of a failure names the kinds.
Result<std::string> picture_to_png(const std::string& picture, const std::string& path);

// The first argument that makes this program the process that does so with what stands at its
// standard input, and what it does then; returns the exit code. Nobody else has a use for it.
inline constexpr const char* kPictureReader = "--read-picture-for-parent";
int read_picture_as_child(const std::string& path);

}  // namespace panache::cli
