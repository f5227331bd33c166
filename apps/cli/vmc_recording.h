#pragma once
// Records a character's motion for a file.

#include <deque>
#include <vector>

#include "clip/clip.h"

namespace panache::cli {

// Drops frames after the first 360,000 (an hour at 100 Hz), to limit memory.
class VmcRecording {
 public:
  // Must precede add(), with poses of this skeleton.
  void start(Skeleton skeleton) { skeleton_ = std::move(skeleton); }
  bool started() const { return !skeleton_.joints.empty(); }
  // Adds a pose of the skeleton's joints at a time in seconds; dropped unless later than the last.
  void add(double seconds, ConstPose pose);
  bool full() const { return frames_.size() >= kMaxFrames; }
  size_t frames() const { return frames_.size(); }

  // As many frames resampled at their mean rate. Requires at least one.
  Clip clip() const;

 private:
  static constexpr size_t kMaxFrames = 360'000;
  struct Frame {
    double seconds;
    std::vector<Quat> rotations;
    std::vector<Vec3> translations;
  };

  Skeleton skeleton_;
  std::deque<Frame> frames_;  // Grows without copying, which would delay a frame.
};

}  // namespace panache::cli
