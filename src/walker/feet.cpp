#include "walker/feet.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pose/foot_lock.h"

namespace panache {
namespace {

constexpr float kMaxOffset = 0.4f;   // Metres; a foot pulled further slides.
constexpr float kMaxTwist = 1.0f;    // Radians, likewise.
constexpr float kSettledOffset = 0.03f, kSettledTwist = 0.12f;
constexpr float kStepLift = 0.05f;   // Height of a step on the spot.
constexpr float kMaxReach = 0.995f;  // Of the length of the leg.
constexpr float kMaxDrop = 0.1f;

float smooth_step(float x) {
  x = std::clamp(x, 0.0f, 1.0f);
  return x * x * (3 - 2 * x);
}
// What is left of an offset at a share of the swing; it is gone before the foot lands.
float left_at(float swing) { return 1 - smooth_step(swing / 0.92f); }

// A knee that straightens at full stretch does so in no time. Where the gait itself does not reach
// as far as `wanted`, the leg comes to its `most` only gradually.
float soft_reach(float wanted, float gait, float most) {
  if (wanted <= gait || gait >= most) return std::min(wanted, std::max(gait, most));
  return gait + (most - gait) * (1 - std::exp(-(wanted - gait) / (most - gait)));
}

float yaw_of(const Leg& leg) { return std::atan2(leg.toe.x - leg.ankle.x, leg.toe.z - leg.ankle.z); }

float wrapped(float angle) {
  constexpr float turn = 2 * std::numbers::pi_v<float>;
  return angle - turn * std::round(angle / turn);
}

}  // namespace

void Feet::hold(Foot& foot, float stands, float swing, float amount, float lead, Vec3 toe,
                float yaw) noexcept {
  if (!foot.known) {
    foot = Foot{};
    foot.known = true;
    foot.toe = toe;
    foot.yaw = yaw;
    return;
  }
  // A foot that stands does not follow the body.
  foot.offset += Vec3{foot.toe.x - toe.x, 0, foot.toe.z - toe.z} * stands;
  foot.twist += wrapped(foot.yaw - yaw) * stands;
  const float pull = length(foot.offset);
  if (pull > kMaxOffset) foot.offset *= kMaxOffset / pull;
  foot.twist = std::clamp(foot.twist, -kMaxTwist, kMaxTwist);
  foot.toe = toe;
  foot.yaw = yaw;
  if (swing > 0 && !foot.lifted) {
    foot.lifted = true;
    const float way = length(foot.offset) + 0.2f * std::abs(foot.twist) +
                      0.2f * std::abs(lead) + amount;
    foot.lift = kStepLift * (1 - amount) * std::min(1.0f, way / 0.08f);
  }
  if (swing <= 0) foot.lifted = false;
}

void Feet::tick(const Drive& drive, const Steps& steps, float lead, float dt,
                Legs& legs) noexcept {
  settled_ = true;
  float drop = 0;
  const Vec3 middle = {static_cast<float>(drive.x()), 0, static_cast<float>(drive.z())};
  for (int f = 0; f < 2; ++f) {
    Leg& leg = legs[f];
    Foot& foot = feet_[f];
    const bool steps_now = drive.is_stepping();
    const float swing = steps_now ? steps.swing[f] : 0;
    const float stands = steps_now ? steps.stands[f] : 1;

    // A foot lands turned ahead of the body and leaves turned behind.
    const float share = swing > 0 ? smooth_step(swing) - 0.5f : 0.5f - steps.stance[f];
    const Quat ahead = rotation_y(lead * share);
    const Vec3 toe = middle + rotate(ahead, leg.toe - middle);
    const Quat to_ahead_foot = ahead * leg.foot;
    const float yaw = wrapped(yaw_of(leg) + lead * share);

    const float before = left_at(swing_[f]);
    if (swing > swing_[f] && before > 0) {
      foot.offset *= left_at(swing) / before;
      foot.twist *= left_at(swing) / before;
    }
    swing_[f] = swing;
    hold(foot, stands, swing, drive.amount(), lead, toe, yaw);
    if (swing > 0 || length(foot.offset) > kSettledOffset ||
        std::abs(foot.twist) > kSettledTwist) {
      settled_ = false;
    }

    const Quat twist = rotation_y(foot.twist);
    const Vec3 sole = rotate(twist, rotate(ahead, leg.toe - leg.ankle));
    const float bump = std::sin(std::numbers::pi_v<float> * swing);
    const float height = std::max(leg.height, 0.0f) * (1 - stands) + foot.lift * bump * bump;
    const Vec3 ankle = Vec3{toe.x + foot.offset.x, height, toe.z + foot.offset.z} - sole;

    const float reach = kMaxReach * (length(leg.knee - leg.hip) + length(leg.ankle - leg.knee));
    const Vec3 way = ankle - leg.hip;
    const float stretched = soft_reach(length(way), length(leg.ankle - leg.hip), reach);
    const TwoBoneTurn turn = two_bone_ik(leg.hip, leg.knee, leg.ankle,
                                         leg.hip + normalized(way) * stretched,
                                         rotate(leg.lower, Vec3{0, 0, 1}));
    const float level = way.x * way.x + way.z * way.z;
    if (reach * reach > level) {
      drop = std::max(drop, stands * (std::sqrt(std::max(0.0f, dot(way, way) - level)) -
                                      std::sqrt(reach * reach - level)));
    }
    leg.upper = turn.upper * leg.upper;
    leg.lower = turn.lower * leg.lower;
    leg.foot = twist * to_ahead_foot;
  }
  drop_ += (std::clamp(drop_ + drop, 0.0f, kMaxDrop) - drop_) * (1 - std::exp(-dt / 0.04f));
  drop_ *= std::exp(-dt / 0.25f);
}

}  // namespace panache
