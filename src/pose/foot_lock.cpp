#include "pose/foot_lock.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"

namespace panache {
namespace {

constexpr float kPlant = 0.6f, kRelease = 0.4f;  // Hysteresis on the contact probability.
constexpr float kMaxOffset = 0.12f;              // Metres; a foot pulled further is let go.
// A foot comes to rest and leaves without a jerk: its speed at the plant dies away with this time
// constant, and the correction of a released foot as a critically damped spring of this rate.
constexpr float kRestSeconds = 0.03f;
constexpr float kFadeRate = 20;    // 1/s
constexpr float kMaxGlide = 1.5f;  // m/s; a faster foot was no foot about to stand.

// Straightening the last degrees of a knee takes no distance but much angle: a leg is never asked
// for more than this share of its length unless the style itself stretches it further.
constexpr float kMaxReach = 0.995f;

}  // namespace

TwoBoneTurn two_bone_ik(Vec3 root, Vec3 middle, Vec3 end, Vec3 target, Vec3 bend_hint) noexcept {
  const float upper = length(middle - root), lower = length(end - middle);
  const Vec3 old_way = end - root, way = target - root;
  const float old_reach = length(old_way);
  if (upper < 1e-5f || lower < 1e-5f || length(way) < 1e-5f) return {};
  const float longest = std::max(old_reach, kMaxReach * (upper + lower));
  const float shortest = std::abs(upper - lower) * 1.001f + 1e-4f;
  const float reach = std::clamp(length(way), std::min(shortest, longest), longest);
  const Vec3 axis = normalized(way);

  // The knee stays in its half-plane: the bend direction turns along with the leg.
  const Vec3 old_axis = normalized(old_way, axis);
  const Quat swing = rotation_between(old_axis, axis);
  Vec3 bend = (middle - root) - old_axis * dot(middle - root, old_axis);
  if (length(bend) < 1e-3f * upper) bend = bend_hint - old_axis * dot(bend_hint, old_axis);
  bend = normalized(rotate(swing, bend));

  // Law of cosines: where along the way the knee is, and how far off it.
  const float along = (upper * upper - lower * lower + reach * reach) / (2 * reach);
  const float off = std::sqrt(std::max(0.0f, upper * upper - along * along));
  const Vec3 knee = root + axis * along + bend * off;
  const Vec3 foot = root + axis * reach;
  TwoBoneTurn turn;
  turn.upper = rotation_between(normalized(middle - root), normalized(knee - root));
  turn.lower = rotation_between(normalized(end - middle), normalized(foot - knee));
  return turn;
}

Vec3 mid_hip(const BodyPose& body) noexcept {
  return (body.joints[index(HumanJoint::left_upper_leg)] +
          body.joints[index(HumanJoint::right_upper_leg)]) *
         0.5f;
}

void changed_joints(const BodyPose& body, const BodyChange& change, HumanPositions& out) noexcept {
  const Quat to_heading = rotation_y(-body.facing);
  // The hips turn about the middle of the hip joints, as in Rig::write.
  out[0] = rotate(change.rotations[0], rotate(to_heading, body.joints[0] - mid_hip(body)));
  for (int j = 1; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    const Vec3 way = rotate(to_heading, body.joints[j] - body.joints[parent]);
    out[j] = out[parent] + rotate(change.rotations[parent], way);
  }
}

void FootLock::follow(Foot& foot, Vec3 toe, float contact, float seconds) noexcept {
  const Vec3 last_offset = foot.offset, last_toe = foot.seen ? foot.toe : toe;
  foot.toe = toe;
  foot.seen = true;
  if (contact < kRelease) foot.state = State::free;
  if (foot.state == State::free && contact > kPlant) {
    foot.state = State::planted;
    foot.anchor = last_toe + last_offset;
    foot.glide = seconds > 0 ? (toe - last_toe) / seconds + foot.speed : Vec3{};
    const float fast = length(foot.glide);
    if (fast > kMaxGlide) foot.glide *= kMaxGlide / fast;
  }
  if (foot.state == State::planted) {
    foot.anchor += foot.glide * seconds;
    foot.glide *= exponential(-seconds / kRestSeconds);
    foot.offset = foot.anchor - toe;
    const float pull = length(foot.offset);
    foot.speed = seconds > 0 ? (foot.offset - last_offset) / seconds : Vec3{};
    if (pull <= kMaxOffset) return;
    foot.state = State::let_go;
    foot.offset = std::isfinite(pull) ? foot.offset * (kMaxOffset / pull) : Vec3{};
    foot.speed = {};
  }
  const Vec3 pace = foot.speed + foot.offset * kFadeRate;
  const float fade = exponential(-seconds * kFadeRate);
  foot.offset = (foot.offset + pace * seconds) * fade;
  foot.speed = (foot.speed - pace * (kFadeRate * seconds)) * fade;
}

void FootLock::step(const BodyPose& body, const HumanPositions& joints,
                    std::span<const float, kFeet> contacts, float amount, float seconds,
                    BodyChange& change) noexcept {
  const Quat to_world = rotation_y(body.facing + change.turn);
  const Vec3 origin = mid_hip(body) + change.translation;
  for (int f = 0; f < kFeet; ++f) {
    Foot& foot = feet_[f];
    follow(foot, origin + rotate(to_world, joints[index(kToes[f])]), contacts[f], seconds);
    if (amount <= 0 || foot.offset == Vec3{}) continue;

    const Vec3 shift = rotate(conjugate(to_world), foot.offset) * amount;
    const int hip = index(kUpperLegs[f]), knee = index(kLowerLegs[f]), ankle = index(kAnkles[f]);
    const TwoBoneTurn turn =
        two_bone_ik(joints[hip], joints[knee], joints[ankle], joints[ankle] + shift, Vec3{0, 0, 1});
    change.rotations[hip] = turn.upper * change.rotations[hip];
    change.rotations[knee] = turn.lower * change.rotations[knee];
  }
}

}  // namespace panache
