#pragma once
// The last third of a second of a body, at whatever rate it came, seen as a window of six poses.

#include <array>
#include <span>

#include "pose/features.h"

namespace panache {

class PoseHistory {
 public:
  explicit PoseHistory(PoseLayout layout) : layout_(layout) {}

  void clear() noexcept { count_ = 0; }
  // Adds the pose at `time` (seconds, never before the last one). The same time again replaces it.
  void push(double time, const HumanPositions& body, const Ground& ground) noexcept;
  // Writes the window that ends at the newest pose: kWindowPoses times pose_numbers(layout), newest
  // first. Times before the first pose show the first pose at rest. At least one pose was pushed.
  void window(std::span<float> out) const noexcept;
  // Mean speed over the ground in the window, m/s.
  float ground_speed() const noexcept;

 private:
  struct Entry {
    double time;
    Ground ground;
    std::array<float, kMaxPoseNumbers - kRootNumbers> numbers;
  };
  // The stored poses around a time: earlier, later, and how far between.
  struct Between {
    const Entry* a;
    const Entry* b;
    float t;
  };
  Between find(double time) const noexcept;
  Ground ground_at(double time) const noexcept;
  const Entry& newest(int age) const noexcept {
    return ring_[(head_ + kCapacity - age) % kCapacity];
  }

  // A pose closer than this to the one before it gives way to the next, so that any rate fits: the
  // window and one more spacing for the oldest velocity need 0.3 s.
  static constexpr double kMinGap = 0.0078;
  static constexpr int kCapacity = 42;

  PoseLayout layout_;
  int head_ = 0, count_ = 0;
  std::array<Entry, kCapacity> ring_;
};

}  // namespace panache
