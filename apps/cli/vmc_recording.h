#pragma once
// What a character did, on its way into a file.

#include <deque>
#include <vector>

#include "clip/clip.h"

namespace panache::cli {

// Memory is bounded: what comes after the first 360,000 frames (an hour at 100 Hz) is left out.
class VmcRecording {
 public:
  // Frames of this skeleton follow.
  void start(Skeleton skeleton) { skeleton_ = std::move(skeleton); }
  bool started() const { return !skeleton_.joints.empty(); }
  // One pose of the skeleton's joints at a time that is later than the last one's, seconds; a pose
  // that is not later is left out.
  void add(double seconds, ConstPose pose);
  bool full() const { return frames_.size() >= kMaxFrames; }
  size_t frames() const { return frames_.size(); }

  // As many frames at their mean rate, between those that came. At least one was added.
  Clip clip() const;

 private:
  static constexpr size_t kMaxFrames = 360'000;
  struct Frame {
    double seconds;
    std::vector<Quat> rotations;
    std::vector<Vec3> translations;
  };

  Skeleton skeleton_;
  std::deque<Frame> frames_;  // Grows without moving what is there: that would hold up a frame.
};

}  // namespace panache::cli
