#include "style/stages/input_watch.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "style/stages/lean.h"

namespace panache {
namespace {

// Canonical body, metres, whose hips are at 0.9 standing, at 0.5 on a chair and at 0.7 in a deep
// lunge.
constexpr float kLowHips = 0.55f, kHighHips = 0.66f;
// Horizontal distance of the body's middle from that of the feet: more than a body can balance.
constexpr float kOverFeet = 0.14f, kBeyondFeet = 0.22f;
// m/s: faster hips do not rest.
constexpr float kRestingHips = 0.15f, kMovingHips = 0.35f;
constexpr float kHipsSeconds = 0.15f, kSeatSeconds = 0.2f;  // Time constants.

// 0 up to `from`, 1 from `to` on; either may be the larger.
float share(float value, float from, float to) { return smooth_step((value - from) / (to - from)); }

// Horizontal distance of the body's middle from that of the feet.
float beyond_feet(const HumanPositions& world) {
  const Vec3 off = centre_over_feet(world);
  return std::hypot(off.x, off.z);
}

}  // namespace

void SeatWatch::step(const HumanPositions& world, const StepTime& time) noexcept {
  const Vec3 hips = world[index(HumanJoint::hips)];
  const float seconds = static_cast<float>(time.input);
  // A first pose counts as resting, so that a clip may begin on a chair.
  if (time.first) speed_ = 0;
  if (!time.first && seconds > 0) {
    const float speed = std::min(length(hips - hips_) / seconds, 2 * kMovingHips);
    speed_ += filter_gain(seconds, kHipsSeconds) * (speed - speed_);
  }
  hips_ = hips;
  const float held = std::max(share(hips.y, kHighHips, kLowHips),
                              share(beyond_feet(world), kOverFeet, kBeyondFeet));
  const float wanted = held * share(speed_, kMovingHips, kRestingHips);
  const float gain = time.first ? 1.0f : filter_gain(seconds, kSeatSeconds);
  approach(amount_, wanted, gain, 1e-4f);
}

namespace {

// m/s over the ground, of both feet together: a slow walk has 1.5, a shift of weight less than 0.2.
constexpr float kStandingFeet = 0.25f, kSteppingFeet = 0.7f;
constexpr float kFastestFeet = 2;  // Limit: a faster foot would keep the tempo long after it stops.
constexpr float kFeetSeconds = 0.3f;  // Time constant.
constexpr std::array kSteppers = {HumanJoint::left_foot, HumanJoint::right_foot};

}  // namespace

void StepWatch::step(const HumanPositions& world, const StepTime& time) noexcept {
  const bool starts = time.first && time.next;
  const float seconds = starts ? time.next->seconds : static_cast<float>(time.input);
  float speed = 0;
  for (size_t f = 0; f < kFeet; ++f) {
    const Vec3 foot = world[index(kSteppers[f])];
    const Vec3 other = starts ? time.next->world[index(kSteppers[f])] : feet_[f];
    if (seconds > 0) speed += std::hypot(foot.x - other.x, foot.z - other.z) / seconds;
    feet_[f] = foot;
  }
  if (time.first) speed_ = 0, seen_ = false;
  if ((time.first && !starts) || seconds <= 0) return;
  speed = std::min(speed, kFastestFeet);
  speed_ += (seen_ ? filter_gain(seconds, kFeetSeconds) : 1.0f) * (speed - speed_);
  seen_ = true;
}

float StepWatch::amount() const noexcept {
  return smooth_step((speed_ - kStandingFeet) / (kSteppingFeet - kStandingFeet));
}

}  // namespace panache
