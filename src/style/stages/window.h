#pragma once
// The input window of the networks.

#include <array>
#include <span>

#include "pose/history.h"
#include "pose/observer.h"
#include "style/stages/step_time.h"

namespace panache {

class InputWindow {
 public:
  // The maximum size of a window, over all layouts.
  static constexpr size_t kMaxNumbers =
      size_t{kWindowPoses} * pose_feature_count(PoseLayout::rotations);

  explicit InputWindow(PoseLayout layout)
      : history_(layout), numbers_(size_t{kWindowPoses} * pose_feature_count(layout)) {}

  void reset() noexcept;
  // Adds a pose, and returns the window that ends at it, see PoseHistory::window(): the first part
  // of `room`, which has kMaxNumbers. The characters of a crowd can share `room`.
  std::span<const float> step(const Observation& now, const StepTime& time,
                              std::span<float> room) noexcept;

  double time() const noexcept { return time_; }  // Input seconds since the start.
  // The newest pose's root features.
  std::span<const float, kRootFeatures> root() const noexcept { return roots_[0]; }
  // Mean over the window, m/s.
  float ground_speed() const noexcept { return ground_speed_; }
  float forward_speed() const noexcept;  // Negative backwards.
  // Prefetches the poses of the next window.
  void fetch_poses(double seconds) const noexcept { history_.fetch_window(seconds); }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.time_), visit(self.roots_), visit(self.ground_speed_);
    PoseHistory::visit_state(self.history_, visit);
  }

 private:
  double time_ = 0;
  float ground_speed_ = 0;
  std::array<std::array<float, kRootFeatures>, kWindowPoses> roots_{};  // Newest first.
  PoseHistory history_;
  size_t numbers_;  // Size of a window.
};

}  // namespace panache
