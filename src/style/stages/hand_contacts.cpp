#include "style/stages/hand_contacts.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "pose/limb.h"
#include "pose/changed_joints.h"

namespace panache {
namespace {

using enum HumanJoint;

// Canonical body, metres: a wrist within the first distance from the head's joint touches head or
// face, or holds a cup or phone; beyond the second there is no contact. The range is wide: with
// 0.25 and 0.33 m, for hands that rest, styles move the arms more in runs and waves, but joints
// jump three times as often and hands at the head go astray by 9 instead of 3 cm (90 %).
constexpr float kAtHead = 0.27f, kOffHead = 0.48f;
// From the axis of a thigh, or of the hips, to a wrist whose hand lies on them, or does not.
constexpr float kOnThigh = 0.15f, kOffThigh = 0.22f, kOnHips = 0.17f, kOffHips = 0.23f;
constexpr float kHipsUp = 0.07f;  // The hips' axis is higher than the hip joints by this.
// m/s: a hand that rests on a thigh or passes it.
constexpr float kRestingHand = 0.2f, kPassingHand = 0.5f;
constexpr float kHandSpeedSeconds = 0.12f;
// Arms of a standing body just hang next to it. A hand on the hips has a bent arm (distance from
// shoulder to wrist as a share of the arm's length); a hand on a thigh has that thigh raised
// (cosine of its angle with the torso).
constexpr float kBent = 0.75f, kStraight = 0.85f, kRaised = 0.6f, kHanging = 0.8f;
// Cosines of the angle between an arm and the torso, not hanging and hanging; and by how much
// further apart hanging hands count.
constexpr float kAway = 0.75f, kDown = 0.92f, kBesides = 0.4f;
// Time constants: a contact rises fast and falls slowly, so that clapping hands stay together.
constexpr float kTakeSeconds = 0.08f, kHandRestSeconds = 0.15f, kGiveSeconds = 0.3f;
// The middle between two hands may be this far from its position relative to the chest, softly.
constexpr float kStray = 0.06f, kMaxStray = 0.12f;
// A wrist is turned by up to this against its forearm to keep to what the hand touches, radians.
constexpr float kWristTurn = 0.6f;
// A contact folds an arm at most to the smallest of its reach in the style, kKeptFold of its reach
// in the input and kFolded of its length: with the wrist at the shoulder the elbow has no defined
// side.
constexpr float kKeptFold = 0.9f, kFolded = 0.4f;
// Metres: a hand on hips or thighs goes with a style that moves it further than the second, and
// stays with one that moves it less than the first.
constexpr float kStyleKeeps = 0.1f, kStyleMoves = 0.25f;
constexpr float kNothing = 1e-5f;  // Metres: no correction.

// 1 at `near` and nearer, 0 from `far` on.
float nearness(float value, float near, float far) {
  return smooth_step((far - value) / (far - near));
}

// How much an arm hangs down along the torso, 0 to 1. `up`: along the torso, unit.
float hangs(const HumanPositions& joints, int side, Vec3 up) {
  const Vec3 direction = normalized(joints[index(kHands[side])] - joints[index(kUpperArms[side])]);
  return 1 - nearness(-dot(direction, up), kAway, kDown);
}

float arm_length(const HumanPositions& joints, int side) {
  const Vec3 elbow = joints[index(kLowerArms[side])];
  return length(elbow - joints[index(kUpperArms[side])]) +
         length(joints[index(kHands[side])] - elbow);
}

// `arm`, from a shoulder to a wrist; if it is shorter than `min`, lengthened to that along the
// unit vector `out`.
Vec3 unfolded(Vec3 arm, Vec3 out, float min) {
  const float lacks = min * min - dot(arm, arm), along = dot(arm, out);
  return lacks > 0 ? arm + out * (std::sqrt(along * along + lacks) - along) : arm;
}

void ease(float& hold, float wanted, float take, float give) {
  approach(hold, wanted, wanted > hold ? take : give, 1e-3f);
}

}  // namespace

void HandContacts::watch(const BodyPose& body, float firmness, const StepTime& time) noexcept {
  const HumanPositions& joints = body.joints;
  const auto at = [&](HumanJoint joint) { return joints[index(joint)]; };
  const float take = time.gain(kTakeSeconds), give = time.gain(kGiveSeconds);
  const float rest = time.gain(kHandRestSeconds);
  const auto seconds = static_cast<float>(time.input);
  const float speed_gain = filter_gain(seconds, kHandSpeedSeconds);
  const Vec3 up = normalized(at(left_upper_arm) + at(right_upper_arm) - at(left_upper_leg) -
                             at(right_upper_leg));
  const float arm = (arm_length(joints, 0) + arm_length(joints, 1)) / 2;
  // Hands hanging next to a narrow body are near each other, too.
  const float hang = hangs(joints, 0, up) * hangs(joints, 1, up);
  const float apart = length(at(right_hand) - at(left_hand)) * (1 + kBesides * hang);
  ease(hands_, arm > 0 ? firmness * hands_nearness(apart / arm) : 0.0f, take, give);

  const auto raised = [&](HumanJoint hip, HumanJoint knee) {
    return nearness(-dot(normalized(at(knee) - at(hip)), up), kRaised, kHanging);
  };
  const std::array<float, 2> thighs = {raised(left_upper_leg, left_lower_leg),
                                       raised(right_upper_leg, right_lower_leg)};
  for (int side = 0; side < 2; ++side) {
    const Vec3 wrist = joints[index(kHands[side])];
    const float off_head = length(wrist - at(HumanJoint::head));
    ease(holds_[side][Part::head],
         has_head(joints) ? firmness * nearness(off_head, kAtHead, kOffHead) : 0.0f, take, give);
    const float reach = length(wrist - joints[index(kUpperArms[side])]);
    const float bent =
        nearness(reach / std::max(arm_length(joints, side), 1e-6f), kBent, kStraight);
    const std::array<Vec3, 3> offsets = {
        from_line(wrist, at(left_upper_leg) + up * kHipsUp, at(right_upper_leg) + up * kHipsUp),
        from_line(wrist, at(left_upper_leg), at(left_lower_leg)),
        from_line(wrist, at(right_upper_leg), at(right_lower_leg))};
    for (int p = 0; p < 3; ++p) {
      float& speed = speeds_[side][p];
      if (time.first) speed = 0;
      if (!time.first && seconds > 0) {
        const float now =
            std::min(length(offsets[p] - offsets_[side][p]) / seconds, 4 * kPassingHand);
        speed += speed_gain * (now - speed);
      }
      const float near = p == 0 ? bent * nearness(length(offsets[p]), kOnHips, kOffHips)
                                : thighs[p - 1] * nearness(length(offsets[p]), kOnThigh, kOffThigh);
      ease(holds_[side][Part::hips + p],
           firmness * near * nearness(speed, kRestingHand, kPassingHand), rest, give);
    }
    offsets_[side] = offsets;
  }
}

float HandContacts::hold(int side, int part) const noexcept {
  const float style = part == Part::head ? 1 : nearness(moved_[side], kStyleKeeps, kStyleMoves);
  return holds_[side][part] * style;
}

HandHolds HandContacts::holds() const noexcept {
  HandHolds holds;
  holds.together = hands_;
  for (int side = 0; side < 2; ++side) {
    for (int p = 0; p < kParts; ++p) {
      holds.by_body[side] = std::max(holds.by_body[side], hold(side, p));
    }
  }
  return holds;
}

void HandContacts::step(const HeadingBody& body, float firmness, std::array<float, 2> amounts,
                        const StepTime& time, HumanPositions& joints, BodyChange& change) noexcept {
  watch(body, firmness, time);
  const bool any = hands_ > 0 || holds_ != Holds{};
  if (!(std::max(amounts[0], amounts[1]) > 0 && any)) {
    elbows_ = {};
    moved_ = {-1, -1};
    return;
  }

  const Vec3 origin = mid_hip(body);
  const auto before = [&](HumanJoint joint) {
    return rotate(body.to_heading, body.joints[index(joint)] - origin);
  };
  const auto turned = [&](HumanJoint joint) { return change.rotations[index(joint)]; };
  // Position of the wrist if it follows `joint` as in the input.
  const auto carried = [&](HumanJoint joint, Vec3 wrist) {
    return joints[index(joint)] + rotate(turned(joint), wrist - before(joint));
  };

  struct Wrist {
    Vec3 now, input, wanted;
    float held = 0;
    Quat carrier, turn;  // Rotation of the touched part, and the hand's share of it.
  };
  std::array<Wrist, 2> wrists;
  constexpr std::array<HumanJoint, kParts> kCarriers = {HumanJoint::head, HumanJoint::hips,
                                                        left_upper_leg, right_upper_leg};
  for (int side = 0; side < 2; ++side) {
    Wrist& wrist = wrists[side];
    wrist.now = joints[index(kHands[side])];
    wrist.input = before(kHands[side]);
    wrist.turn = turned(kHands[side]);
    float off = 0, resting = 0;
    for (int p = Part::hips; p < kParts; ++p) {
      const float there = holds_[side][p];
      if (there > 0) off += there * length(carried(kCarriers[p], wrist.input) - wrist.now);
      resting += there;
    }
    if (resting > 0) {
      float& moved = moved_[side];
      moved += (moved < 0 ? 1.0f : time.gain(kHandRestSeconds)) * (off / resting - moved);
    } else {
      moved_[side] = -1;
    }
    Vec3 sum;
    Quat turns{0, 0, 0, 0};
    float weights = 0;
    for (int p = 0; p < kParts; ++p) {
      const float hold = this->hold(side, p);
      if (!(hold > 0)) continue;
      wrist.held = std::max(wrist.held, hold);
      sum += carried(kCarriers[p], wrist.input) * hold;
      Quat turn = turned(kCarriers[p]);
      const float s = dot(turn, turns) < 0 ? -hold : hold;
      turns = {turns.x + turn.x * s, turns.y + turn.y * s, turns.z + turn.z * s,
               turns.w + turn.w * s};
      weights += hold;
    }
    wrist.wanted = wrist.now;
    if (weights > 0) {
      wrist.wanted = lerp(wrist.now, sum / weights, wrist.held);
      wrist.carrier = normalized(turns);
      wrist.turn = nlerp(wrist.turn, wrist.carrier, wrist.held);
    }
  }
  auto& [left, right] = wrists;
  if (hands_ > 0) {
    // Both hands follow the part that they touch, otherwise the chest.
    const Quat turn = nlerp(turned(chest), left.carrier, left.held * right.held);
    const Vec3 between = rotate(turn, right.input - left.input);
    const Vec3 middle = carried(chest, (left.input + right.input) * 0.5f);
    const Vec3 stray = (left.wanted + right.wanted) * 0.5f - middle;
    const float free = (1 - left.held) * (1 - right.held);
    const Vec3 back = (softly_bounded(stray, kStray, kMaxStray) - stray) * (hands_ * free);
    const float of_right = (1.001f - right.held) / (2.002f - left.held - right.held);
    left.wanted += back;
    right.wanted += back;
    bring_together(between, hands_, of_right, left.wanted, right.wanted);
    for (Wrist& wrist : wrists) wrist.turn = nlerp(wrist.turn, turn, hands_ * (1 - wrist.held));
  }
  for (int side = 0; side < 2; ++side) {
    const Wrist& wrist = wrists[side];
    const float amount = amounts[static_cast<size_t>(side)];
    const Vec3 shift = (wrist.wanted - wrist.now) * amount;
    if (!(length(shift) > kNothing)) {
      elbows_[side] = {};
      continue;
    }
    const Vec3 root = joints[index(kUpperArms[side])];
    const Vec3 input = carried(chest, wrist.input) - carried(chest, before(kUpperArms[side]));
    const float min = std::min(
        {kKeptFold * length(input), kFolded * arm_length(joints, side), length(wrist.now - root)});
    const Vec3 arm = wrist.now + shift - root;
    reach(side, root + unfolded(arm, normalized(input), min),
          carried(chest, before(kLowerArms[side])), time, elbows_[side], joints, change);
    const int hand = index(kHands[side]);
    const Quat forearm = turned(kLowerArms[side]);
    const Quat wanted = nlerp(turned(kHands[side]), wrist.turn, amount);
    const Vec3 bend = log_rotation(conjugate(forearm) * wanted);
    const Vec3 bounded = softly_bounded(bend, kWristTurn, 2 * kWristTurn);
    change.rotations[hand] = normalized(forearm * exp_rotation(bounded));
  }
}

namespace {

// Cosines of the arm's turn at which the elbow no longer follows the style, and still fully does.
constexpr float kFarTurn = 0, kNearTurn = 0.85f;
constexpr float kElbowSeconds = 0.1f;  // Time constant of the elbow's side,
constexpr float kElbowRate = 5;        // and how fast it turns about its arm at most, rad/s.

}  // namespace

void reach(int side, Vec3 target, Vec3 elbow, const StepTime& time, ArmSide& last,
           HumanPositions& joints, BodyChange& change) noexcept {
  const LimbJoints arm = arm_joints(side);
  const Vec3 root = joints[arm.root], end = joints[arm.end];
  const Vec3 from = normalized(end - root), to = normalized(target - root);
  const Quat swing = rotation_between(from, to);
  const float own = smooth_step((dot(from, to) - kFarTurn) / (kNearTurn - kFarTurn));
  const Vec3 style = rotate(swing, normalized(bend_of(root, joints[arm.middle], end, arm.hint)));
  const Vec3 input = normalized(bend_of(root, elbow, target, arm.hint));
  const Vec3 wanted = normalized(lerp(input, style, own), input);
  if (last.side == Vec3{}) last = {style, to};
  const Vec3 carried = rotate(rotation_between(last.direction, to), last.side);
  const Vec3 now = normalized(carried - to * dot(carried, to), style);
  const float turn = arc_tangent(dot(cross(now, wanted), to), dot(now, wanted));
  const float max = kElbowRate * time.output;
  last = {rotate(axis_angle(to, std::clamp(turn * time.gain(kElbowSeconds), -max, max)), now), to};
  aim_limb(arm, target, last.side, joints, change);
}

}  // namespace panache
