#pragma once
// Pushes that move limbs out of the body.

#include <algorithm>
#include <array>
#include <cmath>

#include "base/elementary.h"
#include "pose/limb.h"
#include "style/stages/step_time.h"

namespace panache {

// Metres: a limb may come this much nearer than in the input, so that arms touching the torso and
// legs brushing each other keep their style.
inline constexpr float kFreeDepth = 0.002f;

// The push for a penetration of `depth`, metres: soft at first, `depth` - 6 mm from 12 mm on.
inline float push_of(float depth) noexcept {
  constexpr float kSoft = 0.006f;
  if (!(depth > 0)) return 0;
  return depth < 2 * kSoft ? depth * depth / (4 * kSoft) : depth - kSoft;
}
// How far to push a point at `offset` from an axis along the unit vector `out`, towards its own
// side, to be `reach` away. Past the axis the push is the smaller, the further the point passes by.
inline float push_across(Vec3 offset, Vec3 out, float reach) noexcept {
  const float across = dot(offset, out);
  if (across > reach) return 0;
  const Vec3 along = offset - out * across;
  const float room = reach * reach - dot(along, along);
  if (!(room > 0)) return 0;
  const float wanted = std::sqrt(room);
  const float depth = wanted - (across < 0 ? across * wanted / reach : across);
  return push_of(depth) * smooth_step(wanted / 0.01f);
}
// The push that takes a point at `offset` from an axis, nearer than `reach`, to that distance:
// outwards, but not further away from its side `own`, a unit vector.
inline Vec3 push_out(Vec3 offset, Vec3 own, float reach) noexcept {
  constexpr float kOwn = 0.05f;  // Metres: weight of `own` close to the axis.
  const float far = length(offset), room = reach - far;
  if (!(room > 0)) return {};
  const Vec3 ahead = offset - own * std::min(0.0f, dot(offset, own));
  const Vec3 to = normalized(ahead + own * (kOwn * std::max(0.0f, 1 - far / reach)), own);
  const float along = dot(offset, to);
  // To the exit of the circle; from the far side by the circle's width there.
  const float half = std::sqrt(std::max(0.0f, reach * reach - far * far));
  if (along < 0) return to * (half - along * half / reach);
  const float across = std::sqrt(std::max(0.0f, far * far - along * along));
  return to * push_of(std::sqrt(std::max(0.0f, reach * reach - across * across)) - along);
}
// Extends `push` to at least `length` in the direction `offset`.
inline void raise_push(Vec3& push, Vec3 offset, float length) noexcept {
  const float lacks = length - dot(push, offset);
  if (lacks > 0) push += offset * lacks;
}

// The move of a limb, eased in and out.
class EasedMove {
 public:
  void step(const LimbMove& wanted, const StepTime& time) noexcept {
    constexpr float kNothing = 1e-4f;  // Metres.
    follow(move_.middle, speed_.middle, wanted.middle, time);
    follow(move_.end, speed_.end, wanted.end, time);
    const float far = length(move_.middle) + length(move_.end);
    if (wanted == LimbMove{} && far < kNothing) *this = {};
  }
  const LimbMove& now() const noexcept { return move_; }
  bool rests() const noexcept { return move_ == LimbMove{}; }

 private:
  // Approaches `wanted` with a time constant, slowly enough to stop there, and without a sudden
  // change of speed.
  static void follow(Vec3& at, Vec3& speed, Vec3 wanted, const StepTime& time) noexcept {
    constexpr float kEaseSeconds = 0.05f, kMaxAcceleration = 20;  // m/s2.
    if (time.first) {
      at = wanted, speed = {};
      return;
    }
    if (!(time.output > 0)) return;
    const Vec3 offset = wanted - at;
    const float far = length(offset);
    const float fastest = std::min(far * time.gain(kEaseSeconds) / time.output,
                                   std::sqrt(2 * kMaxAcceleration * far));
    const Vec3 change = normalized(offset) * fastest - speed;
    const float max = kMaxAcceleration * time.output, by = length(change);
    speed += by > max ? change * (max / by) : change;
    at += speed * time.output;
  }

  LimbMove move_, speed_;  // Metres, m/s.
};

// Moves both limbs from their positions in `joints` towards those in `moved` by the shares
// `amounts`, eased; back if `moved` is null. Returns whether any limb moves.
inline bool move_eased(const std::array<LimbJoints, 2>& limbs, const HumanPositions* moved,
                       std::array<float, 2> amounts, const StepTime& time,
                       std::array<EasedMove, 2>& moves, HumanPositions& joints,
                       BodyChange& change) noexcept {
  if (!moved && moves[0].rests() && moves[1].rests()) return false;
  bool any = false;
  for (size_t side = 0; side < 2; ++side) {
    LimbMove wanted;
    if (moved) {
      const auto offset = [&](int joint) {
        return ((*moved)[joint] - joints[joint]) * amounts[side];
      };
      wanted = {offset(limbs[side].middle), offset(limbs[side].end)};
    }
    moves[side].step(wanted, time);
    if (moves[side].rests()) continue;
    move_limb(limbs[side], moves[side].now(), joints, change);
    any = true;
  }
  return any;
}

}  // namespace panache
