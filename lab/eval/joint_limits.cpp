#include "eval/joint_limits.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/quat.h"
#include "rig/canonical_body.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr float kMargin = 20;  // Degrees beyond every range.

// Ranges of motion from the joint's neutral direction, degrees.
struct Range {
  float front, back;  // Flexion, extension.
  float out, in;      // Abduction, adduction; equal for the torso.
};
constexpr Range kTorso = {80, 30, 35, 35};       // Chest relative to hips.
constexpr Range kHead = {45, 45, 45, 45};        // Head relative to chest.
constexpr Range kShoulder = {180, 60, 180, 75};  // Upper arm relative to chest, from hanging down.
constexpr Range kHip = {120, 30, 45, 30};        // Upper leg relative to hips, from hanging down.
// Flexion of a hinge, and hyperextension.
constexpr float kElbow = 150, kElbowBack = 10;
constexpr float kKnee = 135, kKneeBack = 10;
// Within this of straight up, flexion and abduction meet: any arm direction is in range.
constexpr float kOverhead = 45;
// A hinge is hyperextended if it bends within this of the opposite direction: other directions can
// be reached by twisting the upper limb.
constexpr float kWrongWay = 45;

float degrees_between(Vec3 a, Vec3 b) {
  return std::atan2(length(cross(a, b)), dot(a, b)) * 180 / std::numbers::pi_v<float>;
}

// `v` in the coordinates of a frame.
Vec3 seen_in(const Frame& frame, Vec3 v) {
  return {dot(v, frame.x), dot(v, frame.y), dot(v, frame.z)};
}

// How far a unit direction `now` (x out, y up, z ahead) swings beyond its range from `rest` (up or
// down), degrees.
float swing_excess(Vec3 now, Vec3 rest, const Range& range) {
  const float angle = degrees_between(rest, now);
  const float across = std::hypot(now.x, now.z);
  if (across < 1e-6f) return 0;
  const float ahead = now.z / across / (now.z > 0 ? range.front : range.back);
  const float out = now.x / across / (now.x > 0 ? range.out : range.in);
  return angle - 1 / std::hypot(ahead, out) - kMargin;
}

// How far a hinge between two limb directions bends beyond its range, degrees. `bends_to`:
// direction in which the lower limb bends, with the upper limb hanging down.
float hinge_excess(Vec3 upper, Vec3 lower, Vec3 bends_to, float most, float max_back) {
  const float angle = degrees_between(upper, lower);
  const Vec3 to = rotate(rotation_between(Vec3{0, -1, 0}, upper), bends_to);
  const Vec3 bend = lower - upper * dot(upper, lower);
  if (degrees_between(bend, -to) > kWrongWay) return angle - most - kMargin;
  // Either hyperextension or flexion beyond the range: the smaller one counts.
  return std::min(angle - max_back, 360 - angle - most) - kMargin;
}

class Inspection {
 public:
  explicit Inspection(const HumanPositions& body) : body_(body) {
    const Vec3 shoulders = (at(left_upper_arm) + at(right_upper_arm)) * 0.5f;
    hips_ = frame_of(at(left_upper_leg) - at(right_upper_leg), at(spine) - at(hips));
    chest_ = frame_of(at(left_upper_arm) - at(right_upper_arm), shoulders - at(chest));
  }

  BeyondLimit worst() {
    note(spine, swing_excess(mirrored_out(seen_in(hips_, chest_.y)), {0, 1, 0}, kTorso));
    const Vec3 head_up = normalized(at(head) - at(neck));
    note(head, swing_excess(mirrored_out(seen_in(chest_, head_up)), {0, 1, 0}, kHead));
    inspect_arm(left_upper_arm, left_lower_arm, left_hand, 1);
    inspect_arm(right_upper_arm, right_lower_arm, right_hand, -1);
    inspect_leg(left_upper_leg, left_lower_leg, left_foot, 1);
    inspect_leg(right_upper_leg, right_lower_leg, right_foot, -1);
    return worst_;
  }

 private:
  Vec3 at(HumanJoint joint) const { return body_[index(joint)]; }
  // The torso is symmetric.
  static Vec3 mirrored_out(Vec3 v) { return {std::abs(v.x), v.y, v.z}; }
  // From one joint to another, in a frame with x outward on that side.
  Vec3 limb(HumanJoint from, HumanJoint to, const Frame& frame, float side) const {
    const Vec3 v = seen_in(frame, normalized(at(to) - at(from)));
    return {v.x * side, v.y, v.z};
  }
  void note(HumanJoint joint, float excess) {
    if (excess > worst_.degrees) worst_ = {joint, excess};
  }

  void inspect_arm(HumanJoint shoulder, HumanJoint elbow, HumanJoint hand, float side) {
    const Vec3 upper = limb(shoulder, elbow, chest_, side), lower = limb(elbow, hand, chest_, side);
    if (degrees_between(upper, {0, 1, 0}) > kOverhead) {
      note(shoulder, swing_excess(upper, {0, -1, 0}, kShoulder));
      note(elbow, hinge_excess(upper, lower, {0, 0, 1}, kElbow, kElbowBack));
    } else {
      // The twist of a raised arm is not observable.
      note(elbow, degrees_between(upper, lower) - kElbow - kMargin);
    }
  }

  void inspect_leg(HumanJoint hip, HumanJoint knee, HumanJoint foot, float side) {
    const Vec3 upper = limb(hip, knee, hips_, side), lower = limb(knee, foot, hips_, side);
    note(hip, swing_excess(upper, {0, -1, 0}, kHip));
    note(knee, hinge_excess(upper, lower, {0, 0, -1}, kKnee, kKneeBack));
  }

  const HumanPositions& body_;
  Frame hips_, chest_;
  BeyondLimit worst_;
};

}  // namespace

BeyondLimit beyond_limits(const HumanPositions& body) noexcept { return Inspection(body).worst(); }

}  // namespace panache
