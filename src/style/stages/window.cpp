#include "style/stages/window.h"

#include <algorithm>

namespace panache {

void InputWindow::reset() noexcept {
  time_ = 0;
  history_.clear();
}

std::span<const float> InputWindow::step(const Observation& now, const StepTime& time,
                                         std::span<float> room) noexcept {
  time_ += time.input;
  history_.push(time_, now.body_frame, now.root);
  const std::span<float> window = room.first(numbers_);
  ground_speed_ = history_.window(window);
  const size_t pose = numbers_ / kWindowPoses;
  for (size_t k = 0; k < kWindowPoses; ++k) {
    std::ranges::copy(window.subspan(k * pose, pose).last<kRootFeatures>(), roots_[k].begin());
  }
  return window;
}

float InputWindow::forward_speed() const noexcept {
  float sum = 0;
  for (const auto& root : roots_) sum += root[kVelocityForward];
  return sum / kWindowPoses;
}

}  // namespace panache
