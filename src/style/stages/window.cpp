#include "style/stages/window.h"

namespace panache {

void InputWindow::reset() noexcept {
  time_ = 0;
  history_.clear();
}

void InputWindow::step(const Observation& now, const StepTime& time) noexcept {
  time_ += time.input;
  history_.push(time_, now.body_frame, now.root);
  history_.window(window_);
}

std::span<const float, kRootFeatures> InputWindow::root(int pose) const noexcept {
  const size_t numbers = window_.size() / kWindowPoses;
  return window().subspan(static_cast<size_t>(pose) * numbers, numbers).last<kRootFeatures>();
}

std::span<const float, kRootFeatures> InputWindow::root() const noexcept { return root(0); }

float InputWindow::forward_speed() const noexcept {
  float sum = 0;
  for (int k = 0; k < kWindowPoses; ++k) sum += root(k)[kVelocityForward];
  return sum / kWindowPoses;
}

}  // namespace panache
