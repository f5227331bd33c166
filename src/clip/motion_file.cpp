#include "clip/motion_file.h"

#include <cstdio>
#include <string>

#include "clip/motion_format.h"

namespace panache {
namespace {

std::span<const MotionFormat> known_formats = motion_formats();

}  // namespace

void set_motion_formats(std::span<const MotionFormat> formats) { known_formats = formats; }
std::span<const MotionFormat> known_motion_formats() { return known_formats; }

Result<void> check_fps(double fps) {
  if (fps >= kMinFps && fps <= kMaxFps) return {};
  char found[32];
  std::snprintf(found, sizeof found, "%g", fps);
  return Error{std::string("expected a rate of 0.01 to 10000 frames a second, found ") + found};
}

Result<std::unique_ptr<MotionFile>> read_motion(const std::string& path,
                                                const ReadOptions& options) {
  return read_motion(path, known_formats, options);
}

}  // namespace panache
