#include "eval/joint_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/quat.h"
#include "pose/limb.h"
#include "rig/beyond_range.h"
#include "rig/canonical_body.h"

namespace panache {
namespace {

using enum HumanJoint;

// Degrees beyond the ranges, in addition to kRangeMargin.
constexpr float kFurther = 10;
// Within this cosine of straight up, the twist of an arm is not observable.
constexpr float kOverheadArm = 0.7071f;

float in_degrees(float radians) { return radians * 180 / std::numbers::pi_v<float>; }

// `v` in the coordinates of a frame.
Vec3 seen_in(const Frame& frame, Vec3 v) {
  return {dot(v, frame.x), dot(v, frame.y), dot(v, frame.z)};
}

// How far a hinge between two limb directions bends beyond its range, radians. A limb that goes
// through the other one is beyond by the shorter way.
float hinge_beyond(Vec3 upper, Vec3 lower, const Hinge& hinge) {
  const Bend bend = bend_of(upper, lower, hinge);
  const float flexed = bend.angle - hinge.max;
  if (!(bend.wrong > 0)) return flexed;
  const float through = 2 * std::numbers::pi_v<float> - bend.angle - hinge.max;
  return std::max(flexed, std::min(bend.wrong - hinge.back - kRangeMargin, through));
}

class Inspection {
 public:
  explicit Inspection(const HumanPositions& body) : body_(body) {
    const Vec3 shoulders = (at(left_upper_arm) + at(right_upper_arm)) * 0.5f;
    hips_ = frame_of(at(left_upper_leg) - at(right_upper_leg), at(spine) - at(hips));
    chest_ = frame_of(at(left_upper_arm) - at(right_upper_arm), shoulders - at(chest));
  }

  BeyondLimit worst() {
    const Vec3 torso = seen_in(hips_, chest_.y), head_up = seen_in(chest_, direction(neck, head));
    note(spine, swing_beyond(both_sides(torso), kTorsoSwings));
    note(head, swing_beyond(both_sides(head_up), kHeadSwings));
    for (size_t side = 0; side < 2; ++side) {
      const Vec3 upper = limb(kUpperArms[side], kLowerArms[side], chest_, side);
      const Vec3 lower = limb(kLowerArms[side], kHands[side], chest_, side);
      note(kUpperArms[side], swing_beyond(upper, kShoulderSwings));
      note(kLowerArms[side], upper.y < kOverheadArm
                                 ? hinge_beyond(upper, lower, kElbowHinge)
                                 : bend_of(upper, lower, kElbowHinge).angle - kElbowHinge.max);
      const LegBeyond leg = this->leg(side);
      note(kUpperLegs[side], in_radians(leg.thigh));
      note(kLowerLegs[side], in_radians(leg.knee));
    }
    return worst_;
  }
  LegBeyond leg(size_t side) const {
    const Vec3 upper = limb(kUpperLegs[side], kLowerLegs[side], hips_, side);
    const Vec3 lower = limb(kLowerLegs[side], kAnkles[side], hips_, side);
    return {in_degrees(swing_beyond(upper, kHipSwings)),
            in_degrees(hinge_beyond(upper, lower, kKneeHinge))};
  }

 private:
  Vec3 at(HumanJoint joint) const { return body_[index(joint)]; }
  Vec3 direction(HumanJoint from, HumanJoint to) const { return normalized(at(to) - at(from)); }
  // The torso is symmetric.
  static Vec3 both_sides(Vec3 v) { return {std::abs(v.x), v.y, v.z}; }
  // From one joint to another, in a frame with x outward on that side.
  Vec3 limb(HumanJoint from, HumanJoint to, const Frame& frame, size_t side) const {
    const Vec3 v = seen_in(frame, direction(from, to));
    return {side == 0 ? v.x : -v.x, v.y, v.z};
  }
  void note(HumanJoint joint, float beyond) {
    const float excess = in_degrees(beyond) - kFurther;
    if (excess > worst_.degrees) worst_ = {joint, excess};
  }

  const HumanPositions& body_;
  Frame hips_, chest_;
  BeyondLimit worst_;
};

}  // namespace

BeyondLimit beyond_limits(const HumanPositions& body) noexcept { return Inspection(body).worst(); }

LegBeyond leg_beyond(const HumanPositions& body, size_t side) noexcept {
  return Inspection(body).leg(side);
}

}  // namespace panache
