#pragma once
// Converts pictures that FBX files use but glTF does not support.

#include <string>

#include "base/result.h"

namespace panache::cli {

// Converts a TGA, BMP, PSD, GIF, PNM or Radiance picture to PNG, in a sandboxed child process
// (child_process.h). Failure messages list the supported kinds.
Result<std::string> picture_to_png(const std::string& picture, const std::string& path);

// The argument that makes this program the child process that converts its standard input, and the
// child's main function; returns the exit code. For internal use only.
inline constexpr const char* kPictureReader = "--read-picture-for-parent";
int read_picture_as_child(const std::string& path);

}  // namespace panache::cli
