#include "pose/foot_lock.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "pose/limb.h"
#include "pose/changed_joints.h"

namespace panache {
namespace {

constexpr float kPlant = 0.6f, kRelease = 0.4f;  // Hysteresis on the contact probability,
// and on the speed of the input's toe over the ground: whatever the contact is, a foot that leaves
// fast (a spin, a kick) is not held until it is torn away. m/s
constexpr float kStands = 0.8f, kLeaves = 1;
// A planted foot is held in place against a pull of up to kHeld, and trails behind a longer one, by
// kMaxOffset at most. With half of both, and feet held from their landing on, `gorilla` slides 46
// instead of 29 cm/s on the walker, `old` 26 instead of 20. A foot pulled further than that is let
// go if the input's foot has moved as far itself, as in a walk in place; where the input stands,
// that would throw it aside.
constexpr float kHeld = 0.18f, kMaxOffset = 0.22f;  // Metres.
// A planted foot that the style wants elsewhere than where it landed gets there slowly: to within
// kSettled, at kCreep at most, and with kCreepSeconds as the time constant of the rest.
constexpr float kSettled = 0.01f, kCreep = 0.02f, kCreepSeconds = 0.5f;  // Metres, m/s, s.
// A foot comes to rest and leaves without a jerk: its speed at the plant dies away with this time
// constant, and the correction of a released foot as a critically damped spring of this rate.
constexpr float kRestSeconds = 0.03f;
constexpr float kFadeRate = 20;  // 1/s
constexpr float kMaxGlide = 2;   // m/s; a faster foot is not about to stand.

// A planted toe goes to the height of the input's, with this time constant: at half of it, joints
// jump more often; held at the height where it landed, walking toes are a centimetre further off.
constexpr float kLevelSeconds = 0.1f;

// A nearly straight leg follows only a share of changes of its length, or its knee would fly back
// and forth: the sine of the angle between its reach and its length, all of it from this sine on.
// With 1, joints jump a tenth less often and walking toes are 2.6 instead of 2 cm off.
constexpr float kBent = 0.6f;

// A knee that a style or noise bends backwards by a few degrees must not bend further that way: a
// nearly straight leg bends to where its foot points. Fully active from this shift on.
constexpr float kFirm = 0.05f, kFirmShift = 0.02f;  // Metres.
// A nearly straight knee that changes its side turns around the leg at most this fast.
constexpr float kKneeRate = 12;  // Radians/s.

// The position of the ankle instead of `target`.
Vec3 easy_target(Vec3 hip, Vec3 knee, Vec3 ankle, Vec3 target) {
  const float leg = length(knee - hip) + length(ankle - knee);
  const Vec3 offset = target - hip;
  const float before = length(ankle - hip), wanted = length(offset);
  if (!(leg > 0 && wanted > 0)) return target;
  const float share = std::min(1.0f, std::min(before, wanted) / leg);
  const float follow = std::min(1.0f, std::sqrt(1 - share * share) / kBent);
  return hip + offset * ((before + follow * (wanted - before)) / wanted);
}

// How far a planted foot is pulled back to its anchor, at `pull` from it.
Vec3 held(Vec3 pull) {
  constexpr float kGives = kMaxOffset - kHeld;
  const float far = length(pull);
  if (far <= kHeld) return pull;
  if (!std::isfinite(far)) return {};
  return pull * ((kHeld + kGives * (1 - exponential((kHeld - far) / kGives))) / far);
}

// How far a planted foot creeps in `seconds` towards a point at `offset` from it.
Vec3 crept(Vec3 offset, float seconds) {
  const float far = length(offset);
  if (!(far > kSettled && std::isfinite(far))) return {};
  const float eased = (far - kSettled) * filter_gain(seconds, kCreepSeconds);
  return offset * (std::min(kCreep * seconds, eased) / far);
}

}  // namespace

void FootLock::follow(Foot& foot, Vec3 input, Vec3 toe, float contact, float ground,
                      Seconds time) noexcept {
  const float seconds = time.output;
  const bool first = foot.state == State::unseen;
  const Vec3 last_offset = foot.offset, last_toe = first ? toe : foot.toe;
  foot.toe = toe;
  const Vec3 offset = input - foot.input;
  const float moved = !first && time.input > 0 ? std::hypot(offset.x, offset.z) / time.input : 0.0f;
  foot.input = input;
  if (first || contact < kRelease || moved > kLeaves) foot.state = State::free;
  const Vec3 velocity = seconds > 0 ? (toe - last_toe) / seconds + foot.speed : Vec3{};
  const bool stands = contact > kPlant && moved < kStands && length(velocity) < kMaxGlide;
  if (foot.state == State::free && stands) {
    foot.state = State::planted;
    foot.stood = input;
    foot.anchor = last_toe + last_offset;
    foot.glide = velocity;
  }
  if (foot.state == State::planted) {
    foot.anchor += foot.glide * seconds;
    foot.glide *= exponential(-seconds / kRestSeconds);
    // Sliding of the input's foot is not followed.
    foot.anchor += crept(toe - foot.anchor - (input - foot.stood), seconds);
    foot.anchor.y += filter_gain(seconds, kLevelSeconds) * (input.y + ground - foot.anchor.y);
    const Vec3 pull = foot.anchor - toe;
    foot.offset = held(pull);
    foot.speed = seconds > 0 ? (foot.offset - last_offset) / seconds : Vec3{};
    if (!(length(pull) > kMaxOffset && length(input - foot.stood) > kMaxOffset)) return;
    foot.state = State::let_go;
  }
  const Vec3 pace = foot.speed + foot.offset * kFadeRate;
  const float fade = exponential(-seconds * kFadeRate);
  foot.offset = (foot.offset + pace * seconds) * fade;
  foot.speed = (foot.speed - pace * (kFadeRate * seconds)) * fade;
}

Vec3 FootLock::bend(Foot& foot, Vec3 hip, Vec3 knee, Vec3 ankle, Vec3 ahead, float firm,
                    float seconds) noexcept {
  const Vec3 axis = normalized(ankle - hip);
  const Vec3 wanted = normalized(bend_of(hip, knee, ankle, ahead, kFirm * firm));
  const Vec3 last = normalized(across(foot.knee, axis));
  // A small shift of the foot, or a well bent knee, does not move a knee to the other side.
  const float straight = 1 - length(across(knee - hip, axis)) / (2 * kFirm);
  const float share = firm * straight;
  const float max = share > 0 ? kKneeRate * seconds / share : 1.0f;
  const float along = dot(wanted, last);
  if (max >= 1 || last == Vec3{} || (along > 0 && along * along >= 1 - max * max)) {
    foot.knee = wanted;
  } else {
    const Vec3 around = normalized(wanted - last * along, cross(axis, last));
    foot.knee = normalized(last + around * max);
  }
  return foot.knee;
}

void FootLock::step(const BodyPose& body, const HumanPositions& joints,
                    std::span<const float, kFeet> contacts, std::span<const float, kFeet> level,
                    float amount, float ground, Seconds seconds, BodyChange& change) noexcept {
  const float floor = toe_floor(body);
  const Quat to_world = rotation_y(body.facing + change.turn);
  const Vec3 origin = mid_hip(body) + change.translation;
  for (int f = 0; f < kFeet; ++f) {
    Foot& foot = feet_[f];
    const Vec3 toe = origin + rotate(to_world, joints[index(kToes[f])]);
    follow(foot, body.joints[index(kToes[f])], toe, contacts[f], ground, seconds);
    Vec3 offset = foot.offset;
    offset.y *= 1 - level[f];
    offset.y = std::max(offset.y, floor - toe.y);
    if (amount <= 0 || offset == Vec3{}) {
      foot.knee = {};
      continue;
    }

    const int hip = index(kUpperLegs[f]), knee = index(kLowerLegs[f]), ankle = index(kAnkles[f]);
    const Vec3 shift = rotate(conjugate(to_world), offset) * amount;
    const Vec3 target =
        easy_target(joints[hip], joints[knee], joints[ankle], joints[ankle] + shift);
    const float firm = std::min(1.0f, length(shift) / kFirmShift);
    const Vec3 ahead = knee_direction(joints[ankle], joints[index(kToes[f])]);
    const TwoBoneTurn turn = two_bone_ik(
        joints[hip], joints[knee], joints[ankle], target,
        bend(foot, joints[hip], joints[knee], joints[ankle], ahead, firm, seconds.output));
    change.rotations[hip] = turn.upper * change.rotations[hip];
    change.rotations[knee] = turn.lower * change.rotations[knee];
  }
}

}  // namespace panache
