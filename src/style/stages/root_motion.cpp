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
  const Vec3 path = observer.now().root.position - observer.last_root().position;
  drift_ += rotate(rotation_y(turn_), path) - path;
  const float max = speed > 0 ? kMaxStretched : 0.0f;  // Backwards, or the way would not close.
  drift_ += rotate(rotation_y(turn_), path) * std::clamp(share, -kMaxShortened, max);
  climb_.step(observer.now().world, drift_ + sway_, time);
}

namespace {

// A toe slower than this for so long is planted.
constexpr float kStillSpeed = 0.35f, kStillSeconds = 0.08f;  // m/s, s.
// The ground climbs from one plant to the next by more than the first height, on a slope that is
// known already by more than the second; nearer plants than this along the ground show no slope.
constexpr float kClimbs = 0.07f, kStillClimbs = 0.03f, kNearPlants = 0.15f;  // Metres.
constexpr float kSteepest = 1.2f;
constexpr float kFollowSeconds = 0.15f;  // Time constant.

}  // namespace

void Climb::plant(Vec3 toe) noexcept {
  const Vec3 along = {toe.x - plant_.x, 0, toe.z - plant_.z};
  const float far = length(along), climb = toe.y - plant_.y;
  if (planted_ && far < kNearPlants) return;
  const Vec3 last = slope_;
  const bool known = last != Vec3{};
  const bool climbs = planted_ && std::abs(climb) > (known ? kStillClimbs : kClimbs);
  slope_ = {};
  if (climbs && (known || climb * climb_ > 0)) {
    slope_ = along * (std::clamp(climb / far, -kSteepest, kSteepest) / far);
    // The step before was on this slope already.
    if (!known) wanted_ += dot(before_, slope_);
  }
  // Since the last plant the climb was as on the ground before it.
  wanted_ += dot(since_, slope_ - last);
  climb_ = climbs ? climb : 0;
  before_ = since_;
  since_ = {};
  plant_ = toe;
  planted_ = 1;
}

void Climb::step(const BodyPose& body, Vec3 offset, const StepTime& time) noexcept {
  const float seconds = static_cast<float>(time.input);
  if (time.first) reset();
  for (int f = 0; f < kFeet; ++f) {
    Foot& foot = feet_[f];
    const Vec3 toe = body.joints[index(kToes[f])];
    const bool still = !time.first && length(toe - foot.toe) <= kStillSpeed * seconds;
    foot.still = still ? foot.still + seconds : 0;
    foot.toe = toe;
    const bool stands = foot.still >= kStillSeconds;
    if (stands && !foot.stood) plant(toe);
    foot.stood = stands;
  }
  const Vec3 change = time.first ? Vec3{} : offset - offset_;
  offset_ = offset;
  since_ += change;
  wanted_ += dot(change, slope_);
  if (wanted_ != height_) height_ += time.gain(kFollowSeconds) * (wanted_ - height_);
}

}  // namespace panache
