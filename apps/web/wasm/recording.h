#pragma once
// The last seconds of a live motion, to be written as a clip.

#include <vector>

#include "clip/clip.h"

namespace panache::web {

class Recording {
 public:
  // Keeps at least the last `seconds` of motion on `skeleton`.
  Recording(Skeleton skeleton, double seconds) : skeleton_(std::move(skeleton)), keep_(seconds) {}

  // Adds the pose that is shown for the `seconds` after the one before it.
  void add(ConstPose pose, double seconds);
  // The last `seconds`, as far as they are kept, at `fps` frames a second; empty where nothing was
  // added.
  Clip clip(double fps, double seconds) const;

 private:
  Skeleton skeleton_;
  double keep_;
  std::vector<double> times_;  // Of each pose, rising.
  std::vector<Quat> rotations_;
  std::vector<Vec3> translations_;
};

}  // namespace panache::web
