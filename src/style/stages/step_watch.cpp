#include "style/stages/step_watch.h"

#include <algorithm>
#include <cmath>

#include "base/easing.h"

namespace panache {
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
