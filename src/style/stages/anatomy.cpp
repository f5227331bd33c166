#include "style/stages/anatomy.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/elementary.h"
#include "pose/contacts.h"
#include "pose/limb.h"
#include "rig/beyond_range.h"
#include "rig/canonical_body.h"
#include "style/stages/shape.h"

namespace panache {
namespace {

using enum HumanJoint;

// A change is reduced from this much before a limit on; if the input is near or beyond the limit,
// over at least kMin beyond the input.
constexpr float kSoft = in_radians(10), kMin = in_radians(2);
// Time constants of rising and falling shares. With half of the first, jumps of legs and hands by
// more than 6 cm in a frame were three times as frequent; with the first for both, those of knees.
constexpr float kTakeSeconds = 0.16f, kGiveSeconds = 0.3f;

// No joint of legs or torso turns by more than kTurned relative to its parent, softly up to
// kTurnedSoftly more. On a captured walk styles turn them by up to 37 degrees.
constexpr float kTurned = in_radians(60), kTurnedSoftly = in_radians(30), kCosHalfTurned = .8660f;

constexpr float kWrist = in_radians(70), kSafeWrist = .3420f;
// The maximum turn on its forearm of a hand with unknown direction. Radians.
constexpr float kUnknownWrist = in_radians(40);

// The share of a change to take back if it moves a joint from `in` to `out`, both radians beyond a
// limit, negative within it. What is left of it, t -> t room / (t + room), stays within `room` of
// where it begins, and begins without a kink.
float share_back(float out, float in) {
  const float from = std::max(in, -kSoft), room = std::max(kMin, -from), over = out - from;
  return over > 0 ? over / (over + room) * (over / (out - in)) : 0.0f;
}

void bound_turns(std::array<Quat, kHumanJoints>& rotations) {
  const auto is_far = [&](int j) {
    const Region region = region_of(j);
    // This product is the scalar part of its turn relative to its parent.
    return (region == Region::legs || region == Region::torso) &&
           !(std::abs(dot(rotations[kHumanParent[j]], rotations[j])) > kCosHalfTurned);
  };
  int first = index(spine);
  while (first < kHumanJoints && !is_far(first)) ++first;
  if (first == kHumanJoints) return;
  std::array<Quat, kHumanJoints> own;  // Relative to the parent.
  for (int j = index(spine); j < kHumanJoints; ++j) {
    own[j] = conjugate(rotations[kHumanParent[j]]) * rotations[j];
    if (!is_far(j)) continue;
    const Vec3 turn = log_rotation(own[j]);
    const float far = length(turn), over = far - kTurned;
    if (!(over > 0)) continue;
    own[j] = exp_rotation(turn * ((kTurned + kTurnedSoftly * over / (over + kTurnedSoftly)) / far));
  }
  for (int j = index(spine); j < kHumanJoints; ++j) {
    rotations[j] = normalized(rotations[kHumanParent[j]] * own[j]);
  }
}

float angle_between(Vec3 a, Vec3 b) { return arc_tangent(length(cross(a, b)), dot(a, b)); }

Vec3 seen_in(const Frame& frame, Vec3 v) {
  return {dot(v, frame.x), dot(v, frame.y), dot(v, frame.z)};
}

constexpr Vec3 kHanging = {0, -1, 0};
constexpr std::array<float, 2> kOutward = {1, -1};  // Along x, of left and right.
constexpr int kHalvings = 6;  // Of the share of a held leg that is taken back.
// A held leg goes back all the way in no less than this: at once, a foot that rests beside its hip
// jumped by 7 cm, and a quarter of all jumps were such. With twice as much hardly less jumps.
constexpr float kReleaseSeconds = 0.12f;

// A reference joint for limbs, and its frame in the input, heading frame.
struct Base {
  HumanJoint joint;
  Frame frame;
};

// Reduces a change to the limits.
class Limits {
 public:
  Limits(const HeadingBody& body, const StepTime& time, BodyChange& change)
      : body_(body),
        take_(time.gain(kTakeSeconds)),
        give_(time.gain(kGiveSeconds)),
        change_(change) {}

  Base hips_base() const {
    return {hips, frame_of(in_heading(at(left_upper_leg) - at(right_upper_leg)),
                           in_heading(at(spine) - at(hips)))};
  }
  Base chest_base() const {
    const Vec3 shoulders = (at(left_upper_arm) + at(right_upper_arm)) * 0.5f;
    return {chest, frame_of(in_heading(at(left_upper_arm) - at(right_upper_arm)),
                            in_heading(shoulders - at(chest)))};
  }
  Vec3 in_heading(Vec3 world) const { return rotate(body_.to_heading, world); }
  // The direction from one joint to another in the input, heading frame.
  Vec3 direction_between(HumanJoint from, HumanJoint to) const {
    return normalized(in_heading(at(to) - at(from)));
  }
  void ease(float& share, float wanted) const {
    approach(share, wanted, wanted > share ? take_ : give_, 1e-4f);
  }

  // The share to take back if `joint` turns a direction of the input, relative to the base. `side`:
  // the sign of x that is outward for the limb; 0 for both.
  float swing_share(const Base& base, HumanJoint joint, Vec3 direction, const Swings& swings,
                    float side) const {
    const auto beyond = [&](Vec3 v) {
      return swing_beyond({side == 0 ? std::abs(v.x) : v.x * side, v.y, v.z}, swings);
    };
    const Vec3 now = changed(base, joint, direction);
    const float out = dot(now, swings.rest) < swings.safe ? beyond(now) : -kSoft;
    return out > -kSoft ? share_back(out, beyond(seen_in(base.frame, direction))) : 0.0f;
  }
  // Takes back that share, eased in `share`, from all joints from `first` to `last`.
  void keep_swing(const Base& base, HumanJoint joint, Vec3 direction, const Swings& swings,
                  float side, HumanJoint first, HumanJoint last, float& share) {
    ease(share, swing_share(base, joint, direction, swings, side));
    take_back(base, joint, direction, share, first, last);
  }
  // The same, and at once what is beyond the limit after that.
  void hold_swing(const Base& base, HumanJoint joint, Vec3 direction, const Swings& swings,
                  float side, HumanJoint first, HumanJoint last, float& share) {
    keep_swing(base, joint, direction, swings, side, first, last, share);
    take_back(base, joint, direction, swing_share(base, joint, direction, swings, side), first,
              last);
  }

  // How far the thigh or the knee of a leg is beyond both its limit and the input; radians.
  float leg_beyond(const Base& base, size_t side) const {
    const HumanJoint upper = kUpperLegs[side], lower = kLowerLegs[side];
    const Vec3 upper_direction = direction_between(upper, lower),
               lower_direction = direction_between(lower, kAnkles[side]);
    const auto beyond = [&](Vec3 thigh, Vec3 shin) {
      const Vec3 out = {thigh.x * kOutward[side], thigh.y, thigh.z};
      const Bend bend = unsafe_bend_of(thigh, shin, kKneeHinge);
      const float knee = std::max(bend.angle - kKneeHinge.max, bend.wrong - kKneeHinge.back);
      return dot(out, kHipSwings.rest) < kHipSwings.safe
                 ? std::max(swing_beyond(out, kHipSwings), knee)
                 : knee;
    };
    const float out =
        beyond(changed(base, upper, upper_direction), changed(base, lower, lower_direction));
    if (!(out > 0)) return out;
    return out - std::max(0.0f, beyond(seen_in(base.frame, upper_direction),
                                       seen_in(base.frame, lower_direction)));
  }

  // The same for a hinge between two limbs, from the joint of the lower one on.
  void keep_hinge(const Base& base, HumanJoint upper, Vec3 upper_direction, HumanJoint lower,
                  Vec3 lower_direction, const Hinge& hinge, HumanJoint last, float& share) {
    const Vec3 above = changed(base, upper, upper_direction),
               below = changed(base, lower, lower_direction);
    const Bend out = unsafe_bend_of(above, below, hinge);
    float wanted = 0;
    if (out.wrong > 0 || out.angle > hinge.max - kSoft) {
      const Bend in = bend_of(seen_in(base.frame, upper_direction),
                              seen_in(base.frame, lower_direction), hinge);
      const float wrong = std::max(0.0f, out.wrong - in.wrong);
      wanted = std::max(share_back(out.angle - hinge.max, in.angle - hinge.max),
                        wrong / (wrong + hinge.back));
    }
    ease(share, wanted);
    if (share == 0) return;
    // Towards its bend in the input: against the upper limb or, where a style's twist of that would
    // itself bend the hinge the wrong way, to the same side as there. The side of a limb that is
    // raised is not defined.
    constexpr float kRaised = 0.5f, kLow = -0.2f;  // Heights of the upper limb's unit direction.
    const Vec3 before = seen_in(base.frame, upper_direction);
    const float low = smooth_step((kRaised - std::max(above.y, before.y)) / (kRaised - kLow));
    const Quat side =
        rotation_between(kHanging, above) * conjugate(rotation_between(kHanging, before));
    const Vec3 bent = changed(base, upper, lower_direction);
    const Vec3 aside = rotate(side, seen_in(base.frame, lower_direction));
    turn(base, below, normalized(lerp(bent, aside, low), bent), share, lower, last);
  }

  // `local`: the hand's direction in its own axes; zero if unknown.
  void keep_wrist(const Base& base, HumanJoint lower, Vec3 lower_direction, HumanJoint hand,
                  Quat hand_rotation, Vec3 local, float& share) {
    if (local == Vec3{}) return keep_unknown_wrist(lower, hand, share);
    const Vec3 hand_direction = in_heading(rotate(hand_rotation, local));
    const Vec3 above = changed(base, lower, lower_direction),
               now = changed(base, hand, hand_direction);
    float wanted = 0;
    if (dot(above, now) < kSafeWrist) {
      const float out = angle_between(above, now),
                  in = angle_between(lower_direction, hand_direction);
      wanted = share_back(out - kWrist - kRangeMargin, in - kWrist - kRangeMargin);
    }
    ease(share, wanted);
    if (share == 0) return;
    turn(base, now, changed(base, lower, hand_direction), share, hand, hand);
  }

 private:
  Vec3 at(HumanJoint joint) const { return body_.positions[index(joint)]; }
  Quat of(HumanJoint joint) const { return change_.rotations[index(joint)]; }
  // A direction of `joint` in the input, heading frame, after the change, relative to the base.
  Vec3 changed(const Base& base, HumanJoint joint, Vec3 direction) const {
    return seen_in(base.frame, rotate(conjugate(of(base.joint)), rotate(of(joint), direction)));
  }
  // Takes back that share of the turn of a direction of the input from all joints from `first` to
  // `last`.
  void take_back(const Base& base, HumanJoint joint, Vec3 direction, float share, HumanJoint first,
                 HumanJoint last) {
    if (share == 0) return;
    turn(base, changed(base, joint, direction), seen_in(base.frame, direction), share, first, last);
  }
  // Turns all joints from `first` to `last` by a share of the rotation that takes the direction
  // `from` to `to`, both relative to the base.
  void turn(const Base& base, Vec3 from, Vec3 to, float share, HumanJoint first, HumanJoint last) {
    const Vec3 about = cross(from, to);
    const float sine = length(about);
    if (!(sine > 1e-6f)) return;
    const Vec3 axis = rotate(of(base.joint), base.frame(about / sine));
    const Quat back = axis_angle(axis, share * arc_tangent(sine, dot(from, to)));
    for (int j = index(first); j <= index(last); ++j) {
      change_.rotations[j] = normalized(back * change_.rotations[j]);
    }
  }
  void keep_unknown_wrist(HumanJoint lower, HumanJoint hand, float& share) {
    const Vec3 own = log_rotation(conjugate(of(lower)) * of(hand));
    ease(share, share_back(length(own) - kUnknownWrist, -kUnknownWrist));
    if (share == 0) return;
    change_.rotations[index(hand)] = normalized(of(lower) * exp_rotation(own * (1 - share)));
  }

  const HeadingBody& body_;
  float take_, give_;  // Gains of the shares.
  BodyChange& change_;
};

}  // namespace

void Anatomy::step(const HeadingBody& body, const Rig& rig, const StepTime& time,
                   BodyChange& change) noexcept {
  bound_turns(change.rotations);
  Limits limits(body, time, change);
  const Base below = limits.hips_base(), above = limits.chest_base();
  limits.keep_swing(below, chest, above.frame.y, kTorsoSwings, 0, spine, right_hand, torso_);
  limits.keep_swing(above, neck, limits.direction_between(neck, head), kHeadSwings, 0, neck, head,
                    neck_);
  for (size_t side = 0; side < 2; ++side) {
    const HumanJoint upper = kUpperArms[side], lower = kLowerArms[side], hand = kHands[side];
    const Vec3 upper_direction = limits.direction_between(upper, lower),
               lower_direction = limits.direction_between(lower, hand);
    limits.keep_swing(above, upper, upper_direction, kShoulderSwings, kOutward[side], upper, hand,
                      shoulders_[side]);
    limits.keep_hinge(above, upper, upper_direction, lower, lower_direction, kElbowHinge, hand,
                      elbows_[side]);
    limits.keep_wrist(above, lower, lower_direction, hand, body.hands[side],
                      rig.hand_direction(static_cast<int>(side)), wrists_[side]);
  }
  for (size_t side = 0; side < 2; ++side) {
    const HumanJoint upper = kUpperLegs[side], lower = kLowerLegs[side];
    const Vec3 upper_direction = limits.direction_between(upper, lower),
               lower_direction = limits.direction_between(lower, kAnkles[side]);
    limits.hold_swing(below, upper, upper_direction, kHipSwings, kOutward[side], upper, kToes[side],
                      hips_[side]);
    limits.keep_hinge(below, upper, upper_direction, lower, lower_direction, kKneeHinge,
                      kToes[side], knees_[side]);
  }
}

void keep_held_legs(const HeadingBody& body, const BodyChange& free, const StepTime& time,
                    std::array<float, 2>& released, BodyChange& change) noexcept {
  Limits limits(body, time, change);
  const Base base = limits.hips_base();
  for (size_t side = 0; side < 2; ++side) {
    const int upper = index(kUpperLegs[side]), lower = index(kLowerLegs[side]);
    const Quat held_upper = change.rotations[upper], held_lower = change.rotations[lower];
    float& share = released[side];
    approach(share, 0, time.gain(kGiveSeconds), 1e-4f);
    if (held_upper == free.rotations[upper] && held_lower == free.rotations[lower]) continue;
    const auto beyond_at = [&](float released_by) {
      change.rotations[upper] = nlerp(held_upper, free.rotations[upper], released_by);
      change.rotations[lower] = nlerp(held_lower, free.rotations[lower], released_by);
      return limits.leg_beyond(base, side);
    };
    const float held = beyond_at(share);
    if (!(held > 0)) continue;
    const float allowed = std::max(beyond_at(1), 0.0f);
    if (held > allowed) {
      const float max = time.first ? 1.0f : share + time.output / kReleaseSeconds;
      float less = share;
      share = 1;
      for (int i = 0; i < kHalvings; ++i) {
        const float middle = (share + less) / 2;
        (beyond_at(middle) > allowed ? less : share) = middle;
      }
      share = std::min(share, max);
    }
    beyond_at(share);
  }
}

}  // namespace panache
