#include "style/stages/gesture_player.h"

#include <algorithm>

#include "style/stages/strengths.h"

namespace panache {
namespace {

constexpr float kOff = 1e-3f;  // Weaker styles have no gestures.

// The amount of a style's gestures.
float share_of(float strength) { return std::max(0.0f, movement_strength(strength)); }

// As StyleNetworks mixes a style and its mirror image.
GesturePose on_side(float side, const GesturePose& pose) {
  if (side == 1) return pose;
  GesturePose sum = scaled((1 + side) / 2, pose);
  add_scaled((1 - side) / 2, mirrored(pose), sum);
  return sum;
}

}  // namespace

void GesturePlayer::trigger(int style, int gesture) noexcept {
  next_style_ = style;
  next_gesture_ = gesture;
  waited_ = 0;
}

void GesturePlayer::step(const Model& model, std::span<const float> strengths,
                         std::span<const float> sides, float often, const Ground& ground,
                         const StepTime& time) noexcept {
  const float seconds = time.first ? 0 : time.output;
  if (often > 0) draw(model, strengths, often, seconds);
  if (style_ >= 0) {
    time_ += seconds;
    if (time_ >= model.gestures(style_)[gesture_].seconds()) style_ = -1;
  }
  if (style_ < 0 && next_style_ >= 0) start(model, strengths, ground, seconds);
  pose_ = {};
  if (style_ < 0) return;
  const Gesture& gesture = model.gestures(style_)[gesture_];
  const float share = share_of(strengths[style_]) * (1 - ground.flight);
  pose_ = scaled(gesture.moves_hips() ? share * (1 - ground.run) : share,
                 on_side(sides[style_], gesture.at(time_)));
}

void GesturePlayer::draw(const Model& model, std::span<const float> strengths, float often,
                         float seconds) noexcept {
  const auto rate_of = [&](size_t style) {
    if (!(strengths[style] > kOff)) return 0.0f;
    return std::min(strengths[style], 1.0f) * model.gesture_rate(static_cast<int>(style));
  };
  float rate = 0;
  for (size_t style = 0; style < strengths.size(); ++style) rate += rate_of(style);
  if (rate == 0) return;
  // The first one comes as soon as to somebody who looks at any moment.
  if (due_ < 0) due_ = begun_ ? 0.5f + random_.uniform() : random_.uniform();
  begun_ = true;
  due_ -= std::min(often * rate, kMaxGestureRate) * seconds;
  if (due_ > 0 || !rests()) return;
  due_ = -1;
  float chosen = random_.uniform() * rate;
  for (size_t style = 0; style < strengths.size(); ++style) {
    const float own = rate_of(style);
    chosen -= own;
    if (own == 0 || chosen > 0) continue;
    const auto count = static_cast<uint32_t>(model.gestures(static_cast<int>(style)).size());
    return trigger(static_cast<int>(style), static_cast<int>(random_.below(count)));
  }
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
