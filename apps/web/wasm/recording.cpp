#include "recording.h"

#include <algorithm>

namespace panache::web {

void Recording::add(ConstPose pose, double seconds) {
  const double now = times_.empty() ? 0 : times_.back() + seconds;
  // Drop old poses only when they are as many as the rest, so each pose moves at most twice.
  if (!times_.empty() && now - times_.front() > 2 * keep_) {
    const auto old = std::lower_bound(times_.begin(), times_.end(), now - keep_) - times_.begin();
    const auto joints = static_cast<ptrdiff_t>(skeleton_.joints.size());
    times_.erase(times_.begin(), times_.begin() + old);
    rotations_.erase(rotations_.begin(), rotations_.begin() + old * joints);
    translations_.erase(translations_.begin(), translations_.begin() + old * joints);
  }
  times_.push_back(now);
  rotations_.insert(rotations_.end(), pose.rotations.begin(), pose.rotations.end());
  translations_.insert(translations_.end(), pose.translations.begin(), pose.translations.end());
}

Clip Recording::clip(double fps, double seconds) const {
  Clip out;
  out.skeleton = skeleton_;
  out.frame_time = 1 / fps;
  if (times_.empty()) return out;
  const double begin = std::max(times_.front(), times_.back() - seconds);
  out.resize(1 + static_cast<int>((times_.back() - begin) * fps));
  const size_t joints = out.joints();
  size_t after = 1;
  for (int f = 0; f < out.frames; ++f) {
    const double time = begin + f * out.frame_time;
    while (after + 1 < times_.size() && times_[after] < time) ++after;
    const size_t b = std::min(after, times_.size() - 1), a = b > 0 ? b - 1 : 0;
    const double gap = times_[b] - times_[a];
    const auto t = static_cast<float>(gap > 0 ? std::clamp((time - times_[a]) / gap, 0.0, 1.0) : 0);
    const Pose pose = out.pose(f);
    for (size_t j = 0; j < joints; ++j) {
      pose.rotations[j] = nlerp(rotations_[a * joints + j], rotations_[b * joints + j], t);
      pose.translations[j] = lerp(translations_[a * joints + j], translations_[b * joints + j], t);
    }
  }
  return out;
}

}  // namespace panache::web
