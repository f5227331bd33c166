#pragma once
// Records the last seconds of a live motion, to write them as a clip.

#include <vector>

#include "clip/clip.h"

namespace panache::web {

class Recording {
 public:
  // Keeps at least the last `seconds` of motion on `skeleton`.
  Recording(Skeleton skeleton, double seconds) : skeleton_(std::move(skeleton)), keep_(seconds) {}

  // Adds a pose, `seconds` after the last one.
  void add(ConstPose pose, double seconds);
  // The last `seconds`, as far as they are kept, at `fps` frames per second; empty if nothing was
  // added.
  Clip clip(double fps, double seconds) const;

 private:
  Skeleton skeleton_;
  double keep_;
  std::vector<double> times_;  // Time of each pose, ascending.
  std::vector<Quat> rotations_;
  std::vector<Vec3> translations_;
};

}  // namespace panache::web
