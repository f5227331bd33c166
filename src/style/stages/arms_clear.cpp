#include "style/stages/arms_clear.h"

#include "pose/limb.h"

namespace panache {
namespace {

using enum HumanJoint;

// Radii of the canonical body, metres.
constexpr float kTorsoRadius = 0.122f, kSkull = 0.092f, kForearm = 0.036f;
// The torso extends from mid-hip by this share towards mid-shoulder; the skull by this length
// beyond the head's joint, metres.
constexpr float kTorsoEnd = 0.85f, kSkullLength = 0.09f;
// The share of a push that a held wrist resists.
constexpr float kStays = 0.5f;
// A push may lead into another, unless it is small, metres.
constexpr int kPasses = 8;
constexpr float kSmall = 0.005f;

// Positions along a forearm, from the elbow; the hand is beyond 1. Up to kElbow they stay on their
// own side of the torso; hands may be anywhere around it.
constexpr std::array<float, 5> kArmPoints = {0, 0.33f, 0.67f, 1, 1.3f};
constexpr float kElbow = 0.5f;
// An elbow of the input that is this far on its own side counts as being there, metres.
constexpr float kOwnSide = 0.04f;

struct Capsule {
  Vec3 from, to;
  float radius;
};
using TrunkCapsules = std::array<Capsule, 2>;  // Torso and skull.

TrunkCapsules trunk_of(const HumanPositions& joints) {
  const auto at = [&](HumanJoint joint) { return joints[index(joint)]; };
  const Vec3 mid = (at(left_upper_leg) + at(right_upper_leg)) * 0.5f;
  const Vec3 shoulders = (at(left_upper_arm) + at(right_upper_arm)) * 0.5f;
  const Capsule torso = {mid, lerp(mid, shoulders, kTorsoEnd), kTorsoRadius};
  if (!has_head(joints)) return {torso, torso};
  const Vec3 up = normalized(at(head) - at(neck));
  return {torso, Capsule{at(head), at(head) + up * kSkullLength, kSkull}};
}

// From the right to the left shoulder, unit.
Vec3 across_shoulders(const HumanPositions& joints) {
  return normalized(joints[index(left_upper_arm)] - joints[index(right_upper_arm)], {1, 0, 0});
}

float size_of(const LimbMove& move) { return length(move.middle) + length(move.end); }

struct ArmPush {
  LimbMove move;
  float together = 0;  // Metres: of the wrist along Pusher::direction_of_both().
};

class Pusher {
 public:
  // `together`: how much the hands hold each other.
  Pusher(const HeadingBody& body, const BodyChange& change, const TrunkCapsules& trunk,
         float together)
      : body_(body),
        change_(change),
        trunk_(trunk),
        input_trunk_(trunk_of(body.joints)),
        input_across_(across_shoulders(body.joints)) {
    if (together > 0) direction_of_both_ = find_direction_of_both();
  }

  // From the torso's axis to the middle between the hands in the input, unit: the direction for
  // hands that hold each other; 0 if they do not.
  Vec3 direction_of_both() const { return direction_of_both_; }

  ArmPush push_of(const HumanPositions& joints, int side) const {
    const LimbJoints arm = arm_joints(side);
    ArmPush push;
    const Vec3 middle = lerp(joints[arm.middle], joints[arm.end], kArmPoints.back() / 2);
    const float half = length(middle - joints[arm.middle]);
    const Vec3 out = across_shoulders(joints) * (side == 0 ? 1.0f : -1.0f);
    for (size_t c = 0; c < trunk_.size(); ++c) {
      const float reach = trunk_[c].radius + kForearm;
      const bool far = length(from_line(middle, trunk_[c].from, trunk_[c].to)) > half + reach;
      for (const float share : kArmPoints) {
        // An elbow may have passed through to the other side.
        const bool elbow = c == 0 && share < kElbow;
        if (far && !elbow) continue;
        const Vec3 point = lerp(joints[arm.middle], joints[arm.end], share);
        const Vec3 offset = from_line(point, trunk_[c].from, trunk_[c].to);
        if (elbow) {
          push_elbow(out, side, share, offset, reach, push.move.middle);
          continue;
        }
        if (!(length(offset) < reach)) continue;
        const Vec3 was = before(arm, share, c);
        const float kept = std::min(reach, length(was)) - kFreeDepth;
        const Vec3 go = push_out(offset, normalized(carried(c, was)), kept);
        const float depth = length(go);
        if (!(depth > 0)) continue;
        raise_push(push.move.middle, go / depth, depth * std::clamp(2 * (1 - share), 0.0f, 1.0f));
        raise_push(push.move.end, go / depth, depth);
        // That path may be long even if the shortest path out is short.
        if (c > 0 || direction_of_both_ == Vec3{}) continue;
        push.together = std::max(
            push.together, std::min(push_across(offset, direction_of_both_, kept), 2 * depth));
      }
    }
    return push;
  }

 private:
  Vec3 find_direction_of_both() const {
    const auto at = [&](HumanJoint joint) { return body_.joints[index(joint)]; };
    const Capsule& torso = input_trunk_[0];
    const Vec3 up = normalized(torso.to - torso.from);
    const Vec3 hands = (at(left_hand) + at(right_hand)) * 0.5f - torso.from;
    const Vec3 ahead = cross(at(left_upper_arm) - at(right_upper_arm), up);
    return normalized(carried(0, hands - up * dot(hands, up) + ahead * 0.2f));
  }
  // Pushes along the shoulders (`out`, unit, to its own side), to its position in the input.
  void push_elbow(Vec3 out, int side, float share, Vec3 offset, float reach, Vec3& push) const {
    if (!(push_across(offset, out, reach) > 0)) return;
    const Vec3 was = before(arm_joints(side), share, 0);
    const float own = dot(was, input_across_) * (side == 0 ? 1.0f : -1.0f);
    const float kept = (std::min(reach, length(was)) - kFreeDepth) * smooth_step(own / kOwnSide);
    if (kept > 0) raise_push(push, out, push_across(offset, out, kept));
  }
  // From a capsule to a point of a forearm in the input, world.
  Vec3 before(const LimbJoints& arm, float share, size_t capsule) const {
    const Capsule& was = input_trunk_[capsule];
    const Vec3 point = lerp(body_.joints[arm.middle], body_.joints[arm.end], share);
    return from_line(point, was.from, was.to);
  }

  // Applies the change to a vector from a capsule in the input, world.
  Vec3 carried(size_t capsule, Vec3 offset) const {
    const Quat turn = change_.rotations[index(capsule == 0 ? chest : head)];
    return rotate(turn, rotate(body_.to_heading, offset));
  }

  const HeadingBody& body_;
  const BodyChange& change_;
  const TrunkCapsules& trunk_;
  TrunkCapsules input_trunk_;  // World.
  Vec3 input_across_;          // World.
  Vec3 direction_of_both_;     // Heading frame.
};

}  // namespace

void ArmsClear::step(const HeadingBody& body, std::array<float, 2> amounts, const HandHolds& holds,
                     const StepTime& time, HumanPositions& joints, BodyChange& change) noexcept {
  if (!(std::max(amounts[0], amounts[1]) > 0)) return reset();
  const TrunkCapsules trunk = trunk_of(joints);
  const Pusher pusher(body, change, trunk, holds.together);
  HumanPositions moved = joints;
  bool pushed = false;
  for (int pass = 0; pass < kPasses; ++pass) {
    std::array<ArmPush, 2> pushes = {pusher.push_of(moved, 0), pusher.push_of(moved, 1)};
    const float largest = size_of(pushes[0].move) + size_of(pushes[1].move);
    if (largest == 0) break;
    pushed = true;
    const Vec3 both = pusher.direction_of_both() * std::max(pushes[0].together, pushes[1].together);
    for (int side = 0; side < 2; ++side) {
      const LimbJoints arm = arm_joints(side);
      LimbMove push = pushes[side].move;
      push.end = lerp(push.end, both, holds.together);
      const float held = std::max(holds.by_body[side], holds.by_body[1 - side] * holds.together);
      push.end *= 1 - kStays * held;
      // An elbow can swivel only as far as it is bent; the whole arm moves for the rest.
      const float bent = length(from_line(moved[arm.middle], moved[arm.root], moved[arm.end]));
      const float far = length(push.middle);
      if (far > 0) push.end += push.middle * (far / (far + bent) * (1 - holds.together));
      if (push == LimbMove{}) continue;
      move_joints(arm, push, moved);
    }
    if (largest < kSmall) break;
  }
  move_eased({arm_joints(0), arm_joints(1)}, pushed ? &moved : nullptr, amounts, time, moves_,
             joints, change);
}

namespace {

// Radians/s. With 5, a few more joints jump where an elbow arrives late; with 8, elbows jump a
// quarter more often; with 4, hands miss each other by more.
constexpr float kRate = 6;

constexpr std::array<HumanJoint, 6> kArmJoints = {kUpperArms[0], kLowerArms[0], kHands[0],
                                                  kUpperArms[1], kLowerArms[1], kHands[1]};

}  // namespace

ArmRotations arm_rotations(const BodyChange& change) noexcept {
  ArmRotations rotations;
  for (size_t i = 0; i < rotations.size(); ++i) {
    rotations[i] = change.rotations[index(kArmJoints[i])];
  }
  return rotations;
}

void SteadyArms::step(const ArmRotations& before, const StepTime& time,
                      BodyChange& change) noexcept {
  const float max = kRate * time.output;
  for (size_t i = 0; i < before.size(); ++i) {
    Quat &now = change.rotations[index(kArmJoints[i])], &last = corrections_[i];
    const Quat wanted = now == before[i] ? Quat{} : normalized(now * conjugate(before[i]));
    const Vec3 turn = wanted == last ? Vec3{} : log_rotation(wanted * conjugate(last));
    const float far = length(turn);
    if (time.first || far <= max) {
      last = wanted;
      continue;
    }
    last = normalized(exp_rotation(turn * (max / far)) * last);
    now = normalized(last * before[i]);
  }
}

}  // namespace panache
