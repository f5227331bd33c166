#include "style/stages/gesture_player.h"

#include <algorithm>

#include "style/stages/strengths.h"

namespace panache {
namespace {

constexpr float kOff = 1e-3f;  // Weaker styles have no gestures.

// The amount of a style's gestures.
float share_of(float strength) { return std::max(0.0f, movement_strength(strength)); }

}  // namespace

void GesturePlayer::trigger(int style, int gesture) noexcept {
  next_style_ = style;
  next_gesture_ = gesture;
  waited_ = 0;
}

void GesturePlayer::step(const Model& model, std::span<const float> strengths, float rate,
                         const Ground& ground, const StepTime& time) noexcept {
  const float seconds = time.first ? 0 : time.output;
  if (rate > 0) draw(model, strengths, rate, seconds);
  if (style_ >= 0) {
    time_ += seconds;
    if (time_ >= model.gestures(style_)[gesture_].seconds()) style_ = -1;
  }
  if (style_ < 0 && next_style_ >= 0) start(model, strengths, ground, seconds);
  pose_ = {};
  if (style_ < 0) return;
  const Gesture& gesture = model.gestures(style_)[gesture_];
  const float share = share_of(strengths[style_]) * (1 - ground.flight);
  pose_ = scaled(gesture.moves_hips() ? share * (1 - ground.run) : share, gesture.at(time_));
}

// All gestures of all active styles are equally likely.
void GesturePlayer::draw(const Model& model, std::span<const float> strengths, float rate,
                         float seconds) noexcept {
  if (due_ < 0) due_ = 0.5f + random_.uniform();
  due_ -= std::min(rate, kMaxRate) * seconds;
  if (due_ > 0) return;
  due_ = -1;
  if (style_ >= 0 || next_style_ >= 0) return;
  const auto count_of = [&](size_t style) {
    return strengths[style] > kOff ? model.gestures(static_cast<int>(style)).size() : size_t{0};
  };
  size_t count = 0;
  for (size_t style = 0; style < strengths.size(); ++style) count += count_of(style);
  if (count == 0) return;
  size_t chosen = random_.below(static_cast<uint32_t>(count)), style = 0;
  for (; chosen >= count_of(style); ++style) chosen -= count_of(style);
  trigger(static_cast<int>(style), static_cast<int>(chosen));
}

void GesturePlayer::start(const Model& model, std::span<const float> strengths,
                          const Ground& ground, float seconds) noexcept {
  waited_ += seconds;
  if (waited_ > kPatience || !(strengths[next_style_] > kOff)) {
    next_style_ = -1;
    return;
  }
  const bool needs_feet = model.gestures(next_style_)[next_gesture_].moves_hips();
  if (ground.flight > 0 || !ground.holds_body ||
      (needs_feet && !(ground.holds_feet && ground.run == 0)))
    return;
  style_ = next_style_;
  gesture_ = next_gesture_;
  time_ = 0;
  next_style_ = -1;
}

}  // namespace panache
