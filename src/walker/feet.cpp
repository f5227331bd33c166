#include "walker/feet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/elementary.h"
#include "pose/limb.h"

namespace panache {
namespace {

constexpr float kMaxOffset = 0.4f;  // Metres; a foot pulled further slides.
constexpr float kMaxTwist = 1.0f;   // Radians, likewise.
constexpr float kSettledOffset = 0.03f, kSettledTwist = 0.12f;
constexpr float kStepLift = 0.05f;   // Height of a step on the spot.
constexpr float kMaxReach = 0.995f;  // Share of the leg's length.
constexpr float kMaxDrop = 0.1f;

// The rest of an offset at a share of the swing; it is 0 before the foot lands.
float left_at(float swing) { return 1 - smooth_step(swing / 0.92f); }

// A knee near full stretch straightens abruptly. If the gait does not reach as far as `wanted`, the
// leg approaches `max` only gradually.
float soft_reach(float wanted, float gait, float max) {
  if (wanted <= gait || gait >= max) return std::min(wanted, std::max(gait, max));
  return gait + (max - gait) * (1 - std::exp(-(wanted - gait) / (max - gait)));
}

// A swinging toe clears the ground, most in the middle of the swing (`bump` 1).
float above_ground(float height, float bump) {
  const float clearance = 0.03f * bump;
  return (height + std::sqrt(height * height + clearance * clearance)) / 2;
}

float wrapped(float angle) {
  constexpr float turn = 2 * std::numbers::pi_v<float>;
  return angle - turn * std::round(angle / turn);
}

// Bends the leg so that its ankle reaches `ankle`; returns by how much the hip is too high.
float reach_for(Vec3 ankle, Leg& leg) {
  const float max = kMaxReach * (length(leg.knee - leg.hip) + length(leg.ankle - leg.knee));
  const Vec3 to_ankle = ankle - leg.hip;
  const float reach = soft_reach(length(to_ankle), length(leg.ankle - leg.hip), max);
  const Vec3 knee_ahead = rotate(leg.lower, Vec3{0, 0, 1});
  const TwoBoneTurn turn =
      two_bone_ik(leg.hip, leg.knee, leg.ankle, leg.hip + normalized(to_ankle) * reach,
                  bend_of(leg.hip, leg.knee, leg.ankle, knee_ahead));
  leg.upper = turn.upper * leg.upper;
  leg.lower = turn.lower * leg.lower;
  const float level = to_ankle.x * to_ankle.x + to_ankle.z * to_ankle.z;
  return max * max > level ? -to_ankle.y - std::sqrt(max * max - level) : 0.0f;
}

}  // namespace

void Feet::hold(Foot& foot, const Stepping& now, Vec3 toe, float yaw) noexcept {
  if (!foot.known) {
    foot.known = true;
    foot.toe = toe;
    foot.yaw = yaw;
    return;
  }
  // A foot that stands does not follow the body.
  foot.offset += Vec3{foot.toe.x - toe.x, 0, foot.toe.z - toe.z} * now.stands;
  foot.twist += wrapped(foot.yaw - yaw) * now.stands;
  const float pull = length(foot.offset);
  if (pull > kMaxOffset) foot.offset *= kMaxOffset / pull;
  foot.twist = std::clamp(foot.twist, -kMaxTwist, kMaxTwist);
  foot.toe = toe;
  foot.yaw = yaw;
  if (now.swing > 0 && !foot.lifted) {
    foot.lifted = true;
    const float path =
        length(foot.offset) + 0.2f * std::abs(foot.twist) + 0.2f * std::abs(now.lead) + now.amount;
    foot.lift = kStepLift * (1 - now.amount) * std::min(1.0f, path / 0.08f);
  }
  if (now.swing <= 0) foot.lifted = false;
}

void Feet::step(int f, Leg& leg, const Stepping& now) noexcept {
  Foot& foot = feet_[f];
  // A foot lands turned ahead of the body and leaves turned behind.
  const float share = now.swing > 0 ? smooth_step(now.swing) - 0.5f : 0.5f - now.stance;
  const Quat ahead = rotation_y(now.lead * share);
  const Vec3 toe = now.middle + rotate(ahead, leg.toe - now.middle);
  leg.foot = ahead * leg.foot;
  const Vec3 sole = rotate(ahead, leg.toe - leg.ankle);

  const float before = left_at(foot.swing);
  if (now.swing > foot.swing && before > 0) {
    foot.offset *= left_at(now.swing) / before;
    foot.twist *= left_at(now.swing) / before;
  }
  foot.swing = now.swing;
  hold(foot, now, toe, std::atan2(sole.x, sole.z));
  settled_ = settled_ && now.swing <= 0 && length(foot.offset) < kSettledOffset &&
             std::abs(foot.twist) < kSettledTwist;

  const Quat twist = rotation_y(foot.twist);
  const float bump = std::sin(std::numbers::pi_v<float> * now.swing);
  const float height = above_ground(leg.height, bump) * (1 - now.stands) + foot.lift * bump * bump;
  const Vec3 stands_at = {toe.x + foot.offset.x, height, toe.z + foot.offset.z};
  leg.foot = twist * leg.foot;
  needed_drop_ =
      std::max(needed_drop_, now.stands * reach_for(stands_at - rotate(twist, sole), leg));
}

void Feet::tick(const Drive& drive, const Steps& steps, float lead, float dt, Legs& legs) noexcept {
  settled_ = true;
  needed_drop_ = 0;
  Stepping now;
  now.middle = {static_cast<float>(drive.x()), 0, static_cast<float>(drive.z())};
  now.lead = lead;
  now.amount = drive.amount();
  for (int f = 0; f < 2; ++f) {
    const bool stepping = drive.is_stepping();
    now.swing = stepping ? steps.swing[f] : 0;
    now.stands = stepping ? steps.stands[f] : 1;
    now.stance = steps.stance[f];
    step(f, legs[f], now);
  }
  // The hips sink fast while a leg is too short, and rise slowly.
  drop_ += (std::clamp(drop_ + needed_drop_, 0.0f, kMaxDrop) - drop_) * (1 - std::exp(-dt / 0.04f));
  drop_ *= std::exp(-dt / 0.25f);
}

}  // namespace panache
