#include "vmc_recording.h"

#include <algorithm>
#include <cassert>

namespace panache::cli {

void VmcRecording::add(double seconds, ConstPose pose) {
  assert(pose.rotations.size() == skeleton_.joints.size());
  if (full() || (!frames_.empty() && !(seconds > frames_.back().seconds))) return;
  frames_.push_back({seconds,
                     {pose.rotations.begin(), pose.rotations.end()},
                     {pose.translations.begin(), pose.translations.end()}});
}

Clip VmcRecording::clip() const {
  assert(!frames_.empty());
  Clip out;
  out.skeleton = skeleton_;
  const double begin = frames_.front().seconds;
  if (frames_.size() > 1) {
    out.frame_time = (frames_.back().seconds - begin) / static_cast<double>(frames_.size() - 1);
  }
  out.resize(static_cast<int>(frames_.size()));
  size_t later = 0;
  for (int f = 0; f < out.frames; ++f) {
    const double seconds = begin + f * out.frame_time;
    while (later + 1 < frames_.size() && frames_[later].seconds < seconds) ++later;
    const Frame& b = frames_[later];
    const Frame& a = frames_[later > 0 ? later - 1 : 0];
    const double gap = b.seconds - a.seconds;
    const auto t =
        static_cast<float>(gap > 0 ? std::clamp((seconds - a.seconds) / gap, 0.0, 1.0) : 0.0);
    const Pose pose = out.pose(f);
    for (size_t j = 0; j < out.joints(); ++j) {
      pose.rotations[j] = nlerp(a.rotations[j], b.rotations[j], t);
      pose.translations[j] = lerp(a.translations[j], b.translations[j], t);
    }
  }
  return out;
}

}  // namespace panache::cli
