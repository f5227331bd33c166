#include "style/stages/anatomy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/smooth_step.h"
#include "base/elementary.h"
#include "rig/canonical_body.h"
#include "rig/range_of_motion.h"
#include "style/shape.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr float deg(float degrees) { return degrees * std::numbers::pi_v<float> / 180; }

// A change is taken back over this much before a limit; where the input is beyond its limit, or
// near it, over at least kLeast beyond the input.
constexpr float kSoft = deg(10), kLeast = deg(2);
// Time constants of the shares, as they grow and as they go. With half of the first, legs and hands
// jumped by more than 6 cm in a frame, three times as often; with it for both, knees did.
constexpr float kTakeSeconds = 0.16f, kGiveSeconds = 0.3f;

// No joint of legs or torso is turned by more than kTurned beyond what it hangs on, softly up to
// kTurnedSoftly more. On a captured walk styles turn them by up to 37 degrees.
constexpr float kTurned = deg(60), kTurnedSoftly = deg(30), kCosHalfTurned = .8660f;

// The limits are the normal ranges of motion and 10 degrees more, as several joints share a
// movement. Radians. Hinges have no margin the wrong way: it is seen at once.
constexpr float kMargin = deg(10);
struct Range : SwingRange {
  float safe;  // Cosine of the narrowest of them: no closer look is needed up to it.
};
constexpr Range in_radians(const SwingRange& range, float safe) {
  return {{deg(range.front), deg(range.back), deg(range.out), deg(range.in)}, safe};
}
constexpr Range kTorso = in_radians(kTorsoRange, .8660f), kHead = in_radians(kHeadRange, .7071f);
constexpr Range kShoulder = in_radians(kShoulderRange, .5f), kHip = in_radians(kHipRange, .8660f);
constexpr float kWrist = deg(70), kSafeWrist = .3420f;
// A hand whose direction is not known turns no further on its forearm than this. Radians.
constexpr float kUnknownWrist = deg(40);

// The share of a change to take back where it brings something from `in` to `out`, both radians
// beyond a limit, below zero within it. What is left of it, t -> t room / (t + room), stays within
// `room` of where it begins, and begins without a kink.
float share_back(float out, float in) {
  const float from = std::max(in, -kSoft), room = std::max(kLeast, -from), over = out - from;
  return over > 0 ? over / (over + room) * (over / (out - in)) : 0.0f;
}

void bound_turns(std::array<Quat, kHumanJoints>& rotations) {
  std::array<Quat, kHumanJoints> own;  // Beyond the joint that each hangs on.
  bool bounded = false;
  for (int j = index(spine); j < kHumanJoints; ++j) {
    own[j] = conjugate(rotations[kHumanParent[j]]) * rotations[j];
    const Region region = region_of(j);
    if (region != Region::legs && region != Region::torso) continue;
    if (std::abs(own[j].w) > kCosHalfTurned) continue;
    const Vec3 turn = log_rotation(own[j]);
    const float far = length(turn), over = far - kTurned;
    if (!(over > 0)) continue;
    own[j] = exp_rotation(turn * ((kTurned + kTurnedSoftly * over / (over + kTurnedSoftly)) / far));
    bounded = true;
  }
  if (!bounded) return;
  for (int j = index(spine); j < kHumanJoints; ++j) {
    rotations[j] = normalized(rotations[kHumanParent[j]] * own[j]);
  }
}

float angle_between(Vec3 a, Vec3 b) { return arc_tangent(length(cross(a, b)), dot(a, b)); }

Vec3 seen_in(const Frame& frame, Vec3 v) {
  return {dot(v, frame.x), dot(v, frame.y), dot(v, frame.z)};
}

// How far a unit direction (x out, y up, z ahead) swings beyond its range from `rest`, up or down.
float swing_beyond(Vec3 now, Vec3 rest, const Range& range) {
  const float across = std::sqrt(now.x * now.x + now.z * now.z);
  if (across < 1e-6f) return -deg(90);
  const float ahead = now.z / across / (now.z > 0 ? range.front : range.back);
  const float out = now.x / across / (now.x > 0 ? range.out : range.in);
  const float most = 1 / std::sqrt(ahead * ahead + out * out) + kMargin;
  return arc_tangent(across, dot(now, rest)) - most;
}

// The same of an arm.
float arm_beyond(Vec3 now, Vec3 rest, const Range& range) {
  return std::min(swing_beyond(now, rest, range), deg(kOverheadSlope) * (kOverhead - now.y));
}

struct Hinge {
  Vec3 bends_to;  // Where the lower limb goes as it bends, with the upper one hanging down.
  float most, back;
  float safe;  // As in Range, of the right way.
};
constexpr Hinge kElbowHinge = {
    {0, 0, 1}, deg(kElbowRange.most) + kMargin, deg(kElbowRange.back), -.8660f};
constexpr Hinge kKneeHinge = {
    {0, 0, -1}, deg(kKneeRange.most) + kMargin, deg(kKneeRange.back), -.7660f};

struct Bend {
  float angle = 0;  // Radians; 0 where it is safe,
  float wrong = 0;  // and of it the wrong way.
};
// A hinge bends the wrong way within 35 to 75 degrees of the exactly wrong direction.
Bend bend_of(Vec3 upper, Vec3 lower, const Hinge& hinge) {
  const Vec3 to = rotate(rotation_between(Vec3{0, -1, 0}, upper), hinge.bends_to);
  const Vec3 bend = lower - upper * dot(upper, lower);
  const float off = length(bend), along = dot(upper, lower);
  const float wrong =
      off > 1e-6f ? smooth_step((-dot(bend, to) / off - kWrongFrom) / (kWrongTo - kWrongFrom))
                  : 0.0f;
  if (wrong == 0 && along > hinge.safe) return {};
  const float angle = arc_tangent(off, along);
  return {angle, angle * wrong};
}

class Limits {
 public:
  Limits(const BodyPose& body, const Rig& rig, const StepTime& time, float* shares,
         BodyChange& change)
      : body_(body),
        rig_(rig),
        take_(time.gain(kTakeSeconds)),
        give_(time.gain(kGiveSeconds)),
        share_(shares),
        change_(change),
        to_heading_(rotation_y(-body.facing)) {}

  void keep_all() {
    const Vec3 shoulders = (at(left_upper_arm) + at(right_upper_arm)) * 0.5f;
    hips_ = hips_frame();
    chest_ = frame_of(in_heading(at(left_upper_arm) - at(right_upper_arm)),
                      in_heading(shoulders - at(chest)));
    const Base below{hips, hips_}, above{chest, chest_};
    keep_swing(below, swing_of(below, chest, chest_.y, {0, 1, 0}, kTorso, 1), spine, right_hand);
    keep_swing(above, swing_of(above, neck, way(neck, head), {0, 1, 0}, kHead, 1), neck, head);
    keep_arm(0, left_upper_arm, left_lower_arm, left_hand);
    keep_arm(1, right_upper_arm, right_lower_arm, right_hand);
    keep_leg(1, left_upper_leg, left_lower_leg, left_foot, left_toes);
    keep_leg(-1, right_upper_leg, right_lower_leg, right_foot, right_toes);
  }

  void watch_thighs() {
    hips_ = hips_frame();
    eased(thigh_swing(1, left_upper_leg, left_lower_leg).share);
    eased(thigh_swing(-1, right_upper_leg, right_lower_leg).share);
  }

 private:
  // What a limb is seen from: a joint, and its frame in the input.
  struct Base {
    HumanJoint joint;
    const Frame& frame;
  };
  Vec3 at(HumanJoint joint) const { return body_.positions[index(joint)]; }
  Vec3 in_heading(Vec3 world) const { return rotate(to_heading_, world); }
  Vec3 way(HumanJoint from, HumanJoint to) const {
    return normalized(in_heading(at(to) - at(from)));
  }
  Frame hips_frame() const {
    return frame_of(in_heading(at(left_upper_leg) - at(right_upper_leg)),
                    in_heading(at(spine) - at(hips)));
  }
  Quat of(HumanJoint joint) const { return change_.rotations[index(joint)]; }
  // A direction of `joint` in the input, heading frame, as the change has it, seen from the base.
  Vec3 changed(const Base& base, HumanJoint joint, Vec3 direction) const {
    return seen_in(base.frame, rotate(conjugate(of(base.joint)), rotate(of(joint), direction)));
  }
  // Eases the next of the shares to `wanted`.
  float eased(float wanted) {
    approach(*share_, wanted, wanted > *share_ ? take_ : give_, 1e-4f);
    return *share_++;
  }
  // Turns all joints from one to the other by that share of what takes the direction `from` to
  // `to`, both seen from the base.
  void turn(const Base& base, Vec3 from, Vec3 to, float share, HumanJoint first, HumanJoint last) {
    if (share == 0) return;
    const Vec3 about = cross(from, to);
    const float sine = length(about);
    if (!(sine > 1e-6f)) return;
    const Vec3 axis = rotate(of(base.joint), base.frame(about / sine));
    const Quat back = axis_angle(axis, share * arc_tangent(sine, dot(from, to)));
    for (int j = index(first); j <= index(last); ++j) {
      change_.rotations[j] = normalized(back * change_.rotations[j]);
    }
  }

  // A direction of a joint seen from a base, and the share of its change that is to be taken back.
  struct Swing {
    Vec3 now, before;  // With the change, and in the input.
    float share;
  };
  // `side`: 1 or -1 where x is outward for the limb that `joint` turns.
  Swing swing_of(const Base& base, HumanJoint joint, Vec3 direction, Vec3 rest, const Range& range,
                 float side) const {
    const bool is_arm = &range == &kShoulder, both = rest.y > 0;
    const auto beyond = [&](Vec3 v) {
      const Vec3 outward = {both ? std::abs(v.x) : v.x * side, v.y, v.z};
      return is_arm ? arm_beyond(outward, rest, range) : swing_beyond(outward, rest, range);
    };
    const Vec3 now = changed(base, joint, direction), before = seen_in(base.frame, direction);
    const float out = dot(now, rest) < range.safe ? beyond(now) : -kSoft;
    return {now, before, out > -kSoft ? share_back(out, beyond(before)) : 0.0f};
  }
  Swing thigh_swing(float side, HumanJoint upper, HumanJoint lower) const {
    return swing_of({hips, hips_}, upper, way(upper, lower), {0, -1, 0}, kHip, side);
  }
  void keep_swing(const Base& base, const Swing& swing, HumanJoint first, HumanJoint last) {
    turn(base, swing.now, swing.before, eased(swing.share), first, last);
  }

  void keep_hinge(const Base& base, HumanJoint upper, Vec3 upper_way, HumanJoint lower,
                  Vec3 lower_way, const Hinge& hinge, HumanJoint last) {
    const Vec3 above = changed(base, upper, upper_way), below = changed(base, lower, lower_way);
    const Bend out = bend_of(above, below, hinge);
    float share = 0;
    if (out.wrong > 0 || out.angle > hinge.most - kSoft) {
      Hinge exact = hinge;
      exact.safe = 2;
      const Bend in =
          bend_of(seen_in(base.frame, upper_way), seen_in(base.frame, lower_way), exact);
      const float wrong = std::max(0.0f, out.wrong - in.wrong);
      share = std::max(share_back(out.angle - hinge.most, in.angle - hinge.most),
                       wrong / (wrong + hinge.back));
    }
    // To the bend that it has in the input.
    turn(base, below, changed(base, upper, lower_way), eased(share), lower, last);
  }

  void keep_arm(int side, HumanJoint upper, HumanJoint lower, HumanJoint hand) {
    const Base base{chest, chest_};
    const Vec3 upper_way = way(upper, lower), lower_way = way(lower, hand);
    const float outward = side ? -1.0f : 1.0f;
    keep_swing(base, swing_of(base, upper, upper_way, {0, -1, 0}, kShoulder, outward), upper, hand);
    keep_hinge(base, upper, upper_way, lower, lower_way, kElbowHinge, hand);

    const Vec3 local = rig_.hand_direction(side);
    if (local == Vec3{}) return keep_unknown_wrist(lower, hand);
    const Vec3 hand_way = in_heading(rotate(body_.hands[side], local));
    const Vec3 above = changed(base, lower, lower_way), now = changed(base, hand, hand_way);
    float share = 0;
    if (dot(above, now) < kSafeWrist) {
      const float out = angle_between(above, now), in = angle_between(lower_way, hand_way);
      share = share_back(out - kWrist - kMargin, in - kWrist - kMargin);
    }
    share = eased(share);
    turn(base, now, changed(base, lower, hand_way), share, hand, hand);
  }

  void keep_unknown_wrist(HumanJoint lower, HumanJoint hand) {
    const Vec3 own = log_rotation(conjugate(of(lower)) * of(hand));
    const float share = eased(share_back(length(own) - kUnknownWrist, -kUnknownWrist));
    if (share == 0) return;
    change_.rotations[index(hand)] = normalized(of(lower) * exp_rotation(own * (1 - share)));
  }

  void keep_leg(float side, HumanJoint upper, HumanJoint lower, HumanJoint foot, HumanJoint toes) {
    const Base base{hips, hips_};
    keep_swing(base, thigh_swing(side, upper, lower), upper, toes);
    keep_hinge(base, upper, way(upper, lower), lower, way(lower, foot), kKneeHinge, toes);
  }

  const BodyPose& body_;
  const Rig& rig_;
  float take_, give_;  // Gains of the shares,
  float* share_;       // and the next of them.
  BodyChange& change_;
  Quat to_heading_;
  Frame hips_, chest_;  // Of the input, heading frame.
};

}  // namespace

void Anatomy::step(const BodyPose& body, const Rig& rig, const StepTime& time,
                   BodyChange& change) noexcept {
  bound_turns(change.rotations);
  Limits(body, rig, time, shares_.data(), change).keep_all();
}

void Anatomy::watch_thighs(const BodyPose& body, const Rig& rig, const StepTime& time,
                           const BodyChange& change) noexcept {
  BodyChange same = change;
  Limits(body, rig, time, thigh_shares_.data(), same).watch_thighs();
}

}  // namespace panache
