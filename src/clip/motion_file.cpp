#include "clip/motion_file.h"

#include "clip/motion_format.h"

namespace panache {

Result<std::unique_ptr<MotionFile>> read_motion(const std::string& path) {
  return read_motion(path, motion_formats());
}

}  // namespace panache
