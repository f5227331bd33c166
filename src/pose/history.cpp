#include "pose/history.h"

#include <algorithm>
#include <cassert>

namespace panache {

void PoseHistory::push(double time, const HumanPositions& body, const Ground& ground) noexcept {
  const bool replaces = count_ > 0 && (time <= newest(0).time ||
                                       (count_ > 1 && newest(0).time - newest(1).time < kMinGap));
  if (!replaces) {
    head_ = (head_ + 1) % kCapacity;
    count_ = std::min(count_ + 1, kCapacity);
  }
  Entry& entry = ring_[head_];
  entry.time = time;
  entry.ground = ground;
  const size_t count = stored_numbers(layout_);
  write_pose_numbers(layout_, body, std::span(numbers_).subspan(head_ * count, count));
}

PoseHistory::Between PoseHistory::find(double time) const noexcept {
  int later = place(0);
  for (int age = 1; age < count_; ++age) {
    const int earlier = place(age);
    if (ring_[earlier].time <= time) {
      const double gap = ring_[later].time - ring_[earlier].time;
      const double t = gap > 0 ? (time - ring_[earlier].time) / gap : 1;
      return {earlier, later, static_cast<float>(std::clamp(t, 0.0, 1.0))};
    }
    later = earlier;
  }
  const int held = time >= newest(0).time ? place(0) : later;
  return {held, held, 0};
}

Ground PoseHistory::ground_at(double time) const noexcept {
  const auto [a, b, t] = find(time);
  return {lerp(ring_[a].ground.position, ring_[b].ground.position, t),
          ring_[a].ground.facing * (1 - t) + ring_[b].ground.facing * t};
}

void PoseHistory::window(std::span<float> out) const noexcept {
  assert(count_ > 0 && out.size() == size_t(kWindowPoses * pose_numbers(layout_)));
  const int count = stored_numbers(layout_);
  float* number = out.data();
  Ground now = newest(0).ground;
  for (int k = 0; k < kWindowPoses; ++k) {
    const double time = newest(0).time - k * kWindowSpacing;
    const auto [a, b, t] = find(time);
    const std::span<const float> from = numbers(a), to = numbers(b);
    for (int i = 0; i < count; ++i) number[i] = from[i] * (1 - t) + to[i] * t;
    const Ground before = ground_at(time - kWindowSpacing);
    write_root_numbers(before, now, kWindowSpacing,
                       std::span<float, kRootNumbers>(number + count, kRootNumbers));
    now = before;
    number += count + kRootNumbers;
  }
}

float PoseHistory::ground_speed() const noexcept {
  const double seconds = kWindowPoses * kWindowSpacing;
  const Vec3 way = newest(0).ground.position - ground_at(newest(0).time - seconds).position;
  return length(way) / static_cast<float>(seconds);
}

}  // namespace panache
