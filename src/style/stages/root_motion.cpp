#include "style/stages/root_motion.h"

#include <algorithm>
#include <cmath>

#include "base/quat.h"

namespace panache {
namespace {

// Below this speed a character stands, or walks in place: the style may not carry it away.
constexpr float kStandingSpeed = 0.3f;  // m/s
// Well above this speed the root motion changes by the style's full share, below it by less.
constexpr float kSlowSpeed = 0.4f;  // m/s
constexpr float kMaxShortened = 0.8f, kMaxStretched = 1.5f;
// A body that goes back and forth over this many seconds, as a boxer does, goes nowhere.
constexpr float kTravelSeconds = 3;
constexpr float kNoSpeed = 0.01f;  // m/s
// A style turns the body aside by less than this.
constexpr float kMaxTurn = 0.4f;  // Radians.

}  // namespace

void RootMotion::step(const StyleDelta& delta, float gate, const Observer& observer,
                      const InputWindow& window, const StepTime& time) noexcept {
  if (time.first) {
    climb_.step(observer.now().world, {}, time);
    return;
  }
  const float dt = static_cast<float>(time.input);
  // On unfamiliar motion a style does not change the root motion: its mean is that of its walks.
  const float moving = gate * std::min(1.0f, window.ground_speed() / kStandingSpeed);
  // Steps without travel keep their heading and length: stretched forward but not back, they would
  // carry the body away.
  const float speed = window.forward_speed();
  const float follow = filter_gain(dt, kTravelSeconds);
  mean_forward_ += follow * (speed - mean_forward_);
  mean_speed_ += follow * (window.ground_speed() - mean_speed_);
  const float travel = std::min(1.0f, std::abs(mean_forward_) / (mean_speed_ + kNoSpeed));

  const float back = exponential(-dt / kCourseSeconds);
  const float turning = delta.turn_rate * moving * travel * travel * dt;
  const float room = std::max(0.0f, 1 - std::abs(turn_) / kMaxTurn);
  turn_ = turn_ * back + (turning * turn_ > 0 ? turning * room : turning);
  // In world space, so that a sideways offset does not swing around when the body turns.
  const Quat heading = rotation_y(observer.now().root.facing + turn_);
  sway_ = sway_ * back + rotate(heading, Vec3{delta.velocity_left * moving * dt, 0, 0});

  // Forward the style stretches or shortens the input's way by the ratio of its velocity to the
  // input's: a motion that returns in the input returns in the output, and a standing body stays.
  // Each term is exactly zero without a style.
  const float share = gate * travel * travel * delta.velocity_forward * speed /
                      (speed * speed + kSlowSpeed * kSlowSpeed);
  const Vec3 way = observer.now().root.position - observer.last_root().position;
  drift_ += rotate(rotation_y(turn_), way) - way;
  const float max = speed > 0 ? kMaxStretched : 0.0f;  // Backwards, or the way would not close.
  drift_ += rotate(rotation_y(turn_), way) * std::clamp(share, -kMaxShortened, max);
  climb_.step(observer.now().world, drift_ + sway_, time);
}

}  // namespace panache
