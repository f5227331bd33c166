#pragma once
// A motion file as a whole: the clip in it, and all else that must survive a round trip.

#include <memory>
#include <span>
#include <string>

#include "base/result.h"
#include "clip/clip.h"

namespace panache {

class MotionFile {
 public:
  virtual ~MotionFile() = default;

  // The motion, with the file's own joints, order, units and rate.
  virtual const Clip& clip() const = 0;

  // The bytes of the same file with the frames of `changed` in place of its own. `changed` has this
  // file's skeleton and frame time, and any number of frames; source_frames[i] tells which frame of
  // clip() (fractional) its frame i came from. A joint that equals the pose of that frame keeps the
  // very numbers of the file; everything else is written with as many decimals as the file uses.
  virtual std::string encode(const Clip& changed, std::span<const double> source_frames) const = 0;
};

// Reads the motion file at `path`; the ending decides the format (.bvh).
Result<std::unique_ptr<MotionFile>> read_motion(const std::string& path);

}  // namespace panache
