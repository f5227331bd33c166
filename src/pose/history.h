#pragma once
// The last quarter of a second of a body's motion, at any frame rate, as a window of six poses.

#include <array>
#include <span>
#include <vector>

#include "pose/features.h"

namespace panache {

class PoseHistory {
 public:
  explicit PoseHistory(PoseLayout layout)
      : layout_(layout), features_(size_t(kCapacity) * stored_features(layout)) {}

  void clear() noexcept { head_ = kCapacity - 1, count_ = 0; }
  // Adds the pose at `time` (seconds, never before the last one). The same time again replaces it.
  void push(double time, const HumanPositions& body, const RootPose& root) noexcept;
  // Writes the window that ends at the newest pose: kWindowPoses times pose_feature_count(layout),
  // newest first. Times before the first pose show the first pose at rest. At least one pose was
  // pushed. Returns the mean speed over the ground in it, m/s.
  float window(std::span<float> out) const noexcept;
  // Prefetches what window() will read after a push `seconds` from now; in a crowd it has left the
  // caches. Changes nothing.
  void fetch_window(double seconds) const noexcept;

  // Calls visit(member) for all state of a history.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    const auto used = static_cast<size_t>(self.count_);
    visit(self.head_), visit(self.count_), visit(self.ring_, used * sizeof(Entry));
    visit(self.features_, used * stored_features(self.layout_) * sizeof(float));
  }

 private:
  struct Entry {
    double time = 0;
    RootPose root;
  };
  // The stored poses around a time, as indices in the ring: earlier, later, and the fraction
  // between.
  struct Between {
    int a, b;
    float t;
  };
  static constexpr int stored_features(PoseLayout layout) {
    return pose_feature_count(layout) - kRootFeatures;
  }
  // Searches from `age` on, a pose not older than `time` unless it is the newest, and updates it,
  // so that a search for an earlier time can continue from there.
  Between find(double time, int& age) const noexcept;
  RootPose root(const Between& between) const noexcept;
  int index_of(int age) const noexcept {
    return age <= head_ ? head_ - age : head_ - age + kCapacity;
  }
  const Entry& newest(int age) const noexcept { return ring_[index_of(age)]; }
  std::span<const float> features(int slot) const noexcept {
    const size_t count = stored_features(layout_);
    return std::span(features_).subspan(slot * count, count);
  }

  // A pose closer than this to the one before is replaced by the next, so that any rate fits: the
  // window and one more spacing for the oldest velocity need 0.3 s. Trackers send 90 poses a
  // second, and more is not needed: between poses 11 ms apart a foot accelerating at 50 m/s^2 is
  // off by at most 0.8 mm.
  static constexpr double kMinGap = 0.0108;
  static constexpr int kCapacity = 30;

  PoseLayout layout_;
  int head_ = kCapacity - 1, count_ = 0;  // `head_`: the newest; the first push gets index 0.
  std::array<Entry, kCapacity> ring_{};
  std::vector<float> features_;  // [kCapacity][stored_features]
};

}  // namespace panache
