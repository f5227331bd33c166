#include "clip/motion_file.h"

#include "clip/motion_format.h"

namespace panache {
namespace {

std::span<const MotionFormat> known_formats = motion_formats();

}  // namespace

void set_motion_formats(std::span<const MotionFormat> formats) { known_formats = formats; }
std::span<const MotionFormat> known_motion_formats() { return known_formats; }

Result<std::unique_ptr<MotionFile>> read_motion(const std::string& path) {
  return read_motion(path, known_formats);
}

}  // namespace panache
