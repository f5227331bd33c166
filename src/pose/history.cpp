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
  const size_t numbers = pose_numbers(layout_) - kRootNumbers;
  write_pose_numbers(layout_, body, std::span(entry.numbers).first(numbers));
}

PoseHistory::Between PoseHistory::find(double time) const noexcept {
  const Entry* later = &newest(0);
  for (int age = 1; age < count_; ++age) {
    const Entry* earlier = &newest(age);
    if (earlier->time <= time) {
      const double gap = later->time - earlier->time;
      const double t = gap > 0 ? (time - earlier->time) / gap : 1;
      return {earlier, later, static_cast<float>(std::clamp(t, 0.0, 1.0))};
    }
    later = earlier;
  }
  const bool after_newest = time >= newest(0).time;
  const Entry* held = after_newest ? &newest(0) : later;
  return {held, held, 0};
}

Ground PoseHistory::ground_at(double time) const noexcept {
  const auto [a, b, t] = find(time);
  return {lerp(a->ground.position, b->ground.position, t),
          a->ground.facing * (1 - t) + b->ground.facing * t};
}

void PoseHistory::window(std::span<float> out) const noexcept {
  assert(count_ > 0 && out.size() == size_t(kWindowPoses * pose_numbers(layout_)));
  const int numbers = pose_numbers(layout_) - kRootNumbers;
  float* number = out.data();
  Ground now = newest(0).ground;
  for (int k = 0; k < kWindowPoses; ++k) {
    const double time = newest(0).time - k * kWindowSpacing;
    const auto [a, b, t] = find(time);
    for (int i = 0; i < numbers; ++i) number[i] = a->numbers[i] * (1 - t) + b->numbers[i] * t;
    const Ground before = ground_at(time - kWindowSpacing);
    write_root_numbers(before, now, kWindowSpacing,
                       std::span<float, kRootNumbers>(number + numbers, kRootNumbers));
    now = before;
    number += numbers + kRootNumbers;
  }
}

float PoseHistory::ground_speed() const noexcept {
  const double seconds = kWindowPoses * kWindowSpacing;
  const Vec3 way = newest(0).ground.position - ground_at(newest(0).time - seconds).position;
  return length(way) / static_cast<float>(seconds);
}

}  // namespace panache
