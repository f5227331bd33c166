#include "style/stages/climb.h"

#include <algorithm>
#include <cmath>

namespace panache {
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
  const Vec3 way = {toe.x - plant_.x, 0, toe.z - plant_.z};
  const float far = length(way), climb = toe.y - plant_.y;
  if (planted_ && far < kNearPlants) return;
  const Vec3 last = slope_;
  const bool known = last != Vec3{};
  const bool climbs = planted_ && std::abs(climb) > (known ? kStillClimbs : kClimbs);
  slope_ = {};
  if (climbs && (known || climb * climb_ > 0)) {
    slope_ = way * (std::clamp(climb / far, -kSteepest, kSteepest) / far);
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
