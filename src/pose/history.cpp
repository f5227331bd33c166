#include "pose/history.h"

#include <algorithm>
#include <cassert>

#include "base/prefetch.h"

namespace panache {

void PoseHistory::push(double time, const HumanPositions& body, const RootPose& root) noexcept {
  const bool replaces = count_ > 0 && (time <= newest(0).time ||
                                       (count_ > 1 && newest(0).time - newest(1).time < kMinGap));
  if (!replaces) {
    head_ = (head_ + 1) % kCapacity;
    count_ = std::min(count_ + 1, kCapacity);
  }
  Entry& entry = ring_[head_];
  entry.time = time;
  entry.root = root;
  const size_t count = stored_features(layout_);
  write_pose_features(layout_, body, std::span(features_).subspan(head_ * count, count));
}

PoseHistory::Between PoseHistory::find(double time, int& age) const noexcept {
  for (; age + 1 < count_; ++age) {
    const int later = index_of(age), earlier = index_of(age + 1);
    if (ring_[earlier].time <= time) {
      const double gap = ring_[later].time - ring_[earlier].time;
      const double t = gap > 0 ? (time - ring_[earlier].time) / gap : 1;
      return {earlier, later, static_cast<float>(std::clamp(t, 0.0, 1.0))};
    }
  }
  return {index_of(age), index_of(age), 0};  // The oldest.
}

RootPose PoseHistory::root(const Between& between) const noexcept {
  const auto& [a, b, t] = between;
  return interpolate(ring_[a].root, ring_[b].root, t);
}

float PoseHistory::window(std::span<float> out) const noexcept {
  assert(count_ > 0 && out.size() == size_t(kWindowPoses * pose_feature_count(layout_)));
  const int count = stored_features(layout_);
  float* number = out.data();
  RootPose now = newest(0).root;
  int age = 0;
  Between here = find(newest(0).time, age);
  for (int k = 0; k < kWindowPoses; ++k) {
    const auto& [a, b, t] = here;
    const float* from = features(a).data();
    const float* to = features(b).data();
    for (int i = 0; i < count; ++i) number[i] = from[i] * (1 - t) + to[i] * t;
    here = find(newest(0).time - (k + 1) * kWindowSpacing, age);
    const RootPose before = root(here);
    write_root_features(before, now, kWindowSpacing,
                        std::span<float, kRootFeatures>(number + count, kRootFeatures));
    now = before;
    number += count + kRootFeatures;
  }
  constexpr double kSeconds = kWindowPoses * kWindowSpacing;
  return length(newest(0).root.position - now.position) / static_cast<float>(kSeconds);
}

void PoseHistory::fetch_window(double seconds) const noexcept {
  if (count_ == 0) return;
  int age = 0, fetched = 0;  // Poses younger than `fetched` were prefetched.
  for (int k = 0; k < kWindowPoses; ++k) {
    const double time = newest(0).time + seconds - k * kWindowSpacing;
    while (age + 1 < count_ && newest(age).time > time) ++age;
    // The pose before that time and the one after it.
    for (fetched = std::max(fetched, age - 1); fetched <= age && fetched < count_; ++fetched) {
      const std::span<const float> pose = features(index_of(fetched));
      prefetch(pose.data(), pose.size_bytes());
    }
  }
}

}  // namespace panache
