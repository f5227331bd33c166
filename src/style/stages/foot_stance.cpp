#include "style/stages/foot_stance.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "pose/contacts.h"
#include "pose/limb.h"
#include "pose/changed_joints.h"

namespace panache {

namespace {

// A body sinks slowly, so that a hop stays one, but stops sinking quickly. Time constants.
constexpr float kSinkSeconds = 0.8f, kStopSeconds = 0.05f;

// Joints that a lying or kneeling body rests on, and the minimum height of their middle then,
// metres.
struct Rest {
  HumanJoint joint;
  float height;
};
constexpr Rest kRests[] = {{HumanJoint::left_lower_leg, 0.05f},
                           {HumanJoint::right_lower_leg, 0.05f},
                           {HumanJoint::hips, 0.08f}};

// How much deeper a knee or the hips are with `change` than both that height and the input's own.
float resting_depth(const BodyPose& body, const HumanPositions& joints, const BodyChange& change) {
  const float origin = mid_hip(body).y + change.translation.y;
  float depth = 0;
  for (const Rest& rest : kRests) {
    const float lowest = std::min(rest.height, body.joints[index(rest.joint)].y);
    depth = std::max(depth, lowest - (origin + joints[index(rest.joint)].y));
  }
  return depth;
}

// How much higher the lowest toe is with `change` than in the input.
float height_of_toes(const BodyPose& body, const HumanPositions& joints, const BodyChange& change) {
  const auto lowest = [](const HumanPositions& of) {
    return std::min(of[index(kToes[0])].y, of[index(kToes[1])].y);
  };
  return mid_hip(body).y + change.translation.y + lowest(joints) - lowest(body.joints);
}

}  // namespace

float FloorClearance::step(const BodyPose& body, const HumanPositions& joints, float amount,
                           float carried, float ground, const StepTime& time,
                           const BodyChange& change) noexcept {
  const float depth =
      std::max(floor_depth(body, joints, change), resting_depth(body, joints, change));
  const float height = carried * std::max(0.0f, height_of_toes(body, joints, change) - ground);
  const float seconds = height > sink_ ? kSinkSeconds : kStopSeconds;
  approach(sink_, height, time.gain(seconds), 1e-5f);
  return amount * (depth - sink_);
}

namespace {

constexpr float kRestingFoot = 0.1f, kMovingFoot = 0.3f;  // m/s
constexpr float kFastestFoot = 1;                         // m/s, limit for the filter.
constexpr float kLowToe = 0.12f, kHighToe = 0.2f;         // Metres: a raised foot is the style's.
constexpr float kSpeedSeconds = 0.06f, kRestSeconds = 0.1f;  // Time constants,
constexpr float kHeightSeconds = 0.04f;                      // of the hips' height; twice.
constexpr float kFreeTurn = 0.17f;  // Radians that a foot may be turned beyond its style's stance.
constexpr float kReach = 0.985f;    // Maximum stretch, as a share of the leg's length.
constexpr float kFirm = 0.05f;      // See bend_of(), metres.

// How far `turn` rotates about the unit `axis`, radians, -pi to pi.
float angle_about(Vec3 axis, Quat turn) {
  const float sign = turn.w < 0 ? -1.0f : 1.0f;
  return 2 * arc_tangent(sign * dot(axis, turn.xyz()), sign * turn.w);
}

}  // namespace

void FootStance::watch(const BodyPose& body, int f, const StepTime& time, Foot& foot) noexcept {
  const Vec3 ankle = body.joints[index(kAnkles[f])], toe = body.joints[index(kToes[f])];
  const bool starts = time.first && time.next;
  const float seconds = starts ? time.next->seconds : static_cast<float>(time.input);
  if (time.first) foot = {};
  const Vec3 other_ankle = starts ? time.next->world[index(kAnkles[f])] : foot.ankle;
  const Vec3 other_toe = starts ? time.next->world[index(kToes[f])] : foot.toe;
  foot.ankle = ankle;
  foot.toe = toe;
  if ((time.first && !starts) || seconds <= 0) return;
  // The first speed that is known counts in full.
  const auto gain = [&](float time_constant) {
    return foot.seen ? filter_gain(seconds, time_constant) : 1.0f;
  };
  const float speed = std::max(length(ankle - other_ankle), length(toe - other_toe)) / seconds;
  foot.speed += gain(kSpeedSeconds) * (std::min(speed, kFastestFoot) - foot.speed);
  const float wanted = smooth_step((kMovingFoot - foot.speed) / (kMovingFoot - kRestingFoot)) *
                       smooth_step((kHighToe - toe.y) / (kHighToe - kLowToe));
  // Two filters in series, so that it begins and ends without a jerk.
  approach(foot.wanted, wanted, gain(kRestSeconds), 1e-4f);
  approach(foot.rest, foot.wanted, gain(kRestSeconds), 1e-4f);
  foot.seen = 1;
}

void FootStance::move_hips(float height, float gain, BodyChange& change) noexcept {
  approach(height_wanted_, height, gain, 1e-5f);
  approach(height_, height_wanted_, gain, 1e-5f);
  change.translation.y += height_;
}

void FootStance::step(const HeadingBody& body, HumanPositions& joints, const Stance& stance,
                      float amount, float stepping, float lift, float raised, float flight,
                      const StepTime& time, BodyChange& change) noexcept {
  const float standing = amount * (1 - stepping) * (1 - flight);
  const bool fresh = time.first || !feet_[0].seen;
  for (int f = 0; f < kFeet; ++f) {
    watch(body, f, time, feet_[f]);
    held_[f] = standing * feet_[f].rest;
  }
  const float gain = time.first ? 1.0f : (1 - flight) * filter_gain(time.output, kHeightSeconds);
  if (!(held_[0] > 0 || held_[1] > 0)) return move_hips(raised, gain, change);

  for (int f = 0; f < kFeet; ++f) {
    const int ankle = index(kAnkles[f]), toe = index(kToes[f]);
    Quat& foot = change.rotations[ankle];
    const float min = std::min(0.0f, stance.turn[f]), max = std::max(0.0f, stance.turn[f]);
    const float yaw = angle_about({0, 1, 0}, foot);
    const Quat turn = rotation_y(std::clamp(yaw, min - kFreeTurn, max + kFreeTurn));
    Vec3 ahead = body.offsets[toe];
    ahead.y = 0;
    const Vec3 side = cross({0, 1, 0}, normalized(ahead, {0, 0, 1}));
    const float tilt = angle_about(side, rotation_y(-yaw) * foot);
    const float heel = std::clamp(tilt, 0.0f, std::max(0.0f, stance.heel));
    foot = nlerp(foot, turn * axis_angle(side, heel), held_[f]);
    Quat& toes = change.rotations[toe];
    toes = nlerp(toes, turn, held_[f]);
  }
  changed_legs(body, change, joints);

  // How far the hips drop so that the legs reach.
  const float origin = mid_hip(body).y + change.translation.y;
  const auto rise_of = [&](int f, float hips) {
    return held_[f] * (feet_[f].toe.y + lift - (hips + joints[index(kToes[f])].y));
  };
  float drop = 0;
  for (int f = 0; f < kFeet; ++f) {
    const Vec3 hip = joints[index(kUpperLegs[f])], knee = joints[index(kLowerLegs[f])];
    const Vec3 ankle = joints[index(kAnkles[f])];
    const Vec3 leg_line = ankle - hip;
    const float leg = kReach * (length(knee - hip) + length(ankle - knee));
    const float aside = leg_line.x * leg_line.x + leg_line.z * leg_line.z;
    const float down = std::sqrt(std::max(0.0f, leg * leg - aside));
    const float now = std::max(down, -leg_line.y);  // Legs that are straight may stay so.
    drop = std::max(drop, held_[f] * (-(leg_line.y + rise_of(f, origin + raised)) - now));
  }
  move_hips(raised - drop, fresh ? 1.0f : gain, change);
  for (int f = 0; f < kFeet; ++f) {
    const float up = rise_of(f, mid_hip(body).y + change.translation.y);
    if (!(held_[f] > 0) || up == 0) continue;
    const LimbJoints leg = leg_joints(f);
    const Vec3 ankle = joints[leg.end], ahead = knee_direction(ankle, joints[index(kToes[f])]);
    turn_limb(leg, ankle + Vec3{0, up, 0},
              bend_of(joints[leg.root], joints[leg.middle], ankle, ahead, kFirm), joints, change);
  }
  changed_legs(body, change, joints);
}

}  // namespace panache
