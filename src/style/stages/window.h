#pragma once
// Second stage: the window that the networks see.

#include <span>
#include <vector>

#include "pose/history.h"
#include "pose/observer.h"
#include "style/stages/step_time.h"

namespace panache {

class InputWindow {
 public:
  explicit InputWindow(PoseLayout layout)
      : history_(layout), window_(size_t{kWindowPoses} * pose_feature_count(layout)) {}

  void reset() noexcept;
  void step(const Observation& now, const StepTime& time) noexcept;

  double time() const noexcept { return time_; }  // Input seconds since the start.
  // As PoseHistory::window() gives it.
  std::span<const float> window() const noexcept { return window_; }
  // The newest pose's root activations.
  std::span<const float, kRootFeatures> root() const noexcept;
  float ground_speed() const noexcept { return history_.ground_speed(); }
  // Mean over the window, m/s; below zero backwards.
  float forward_speed() const noexcept;
  void fetch(double seconds) const noexcept { history_.fetch_window(seconds); }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.time_), visit(self.window_);
    PoseHistory::visit_state(self.history_, visit);
  }

 private:
  std::span<const float, kRootFeatures> root(int pose) const noexcept;

  double time_ = 0;
  PoseHistory history_;
  std::vector<float> window_;  // [kWindowPoses][pose numbers], newest first.
};

}  // namespace panache
