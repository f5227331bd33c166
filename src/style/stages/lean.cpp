#include "style/stages/lean.h"

#include <algorithm>
#include <cmath>

#include "base/elementary.h"
#include "pose/changed_joints.h"

namespace panache {
namespace {

using enum HumanJoint;

// How far a change may freely move the centre, and the maximum beyond; metres.
constexpr float kFree = 0.08f, kRoom = 0.05f;
// An upper body whose centre is lower over the hips cannot be righted by turning; metres.
constexpr float kLever = 0.05f;

constexpr float kJoints = kHumanJoints;

void turn_upper_body(Quat turn, const HeadingBody& body, HumanPositions& joints,
                     BodyChange& change) {
  for (int j = index(hips); j <= index(right_hand); ++j) {
    change.rotations[j] = normalized(turn * change.rotations[j]);
  }
  changed_joints(body, change, joints);
}

}  // namespace

Vec3 torso_direction(const HumanPositions& joints) noexcept {
  return normalized(joints[index(left_upper_arm)] + joints[index(right_upper_arm)] -
                    joints[index(left_upper_leg)] - joints[index(right_upper_leg)]);
}

Vec3 centre_over_feet(const HumanPositions& joints) noexcept {
  Vec3 sum, feet;
  for (const Vec3& joint : joints) sum += joint;
  for (size_t f = 0; f < kFeet; ++f) {
    feet += joints[index(kAnkles[f])] + joints[index(kToes[f])];
  }
  return sum / kJoints - feet / (2.0f * kFeet);
}

void keep_balance(const HeadingBody& body, float amount, HumanPositions& joints,
                  BodyChange& change) noexcept {
  Vec3 moved = centre_over_feet(joints) - rotate(body.to_heading, centre_over_feet(body.joints));
  moved.y = 0;
  const float far = length(moved), over = far - kFree;
  if (!(over > 0)) return;
  const Vec3 direction = moved / far;
  // The remaining part of `over`, t -> t room / (t + room), is smooth at 0.
  const float back = amount * over * over / (over + kRoom);

  Vec3 upper;  // The part of the centre that turns, from mid-hip.
  for (int j = index(hips); j <= index(right_hand); ++j) upper += joints[j] / kJoints;
  const float height = std::max(upper.y, 0.0f);
  const float wanted = back * height / (height * height + kLever * kLever);
  const float leans = dot(
      torso_direction(joints) - rotate(body.to_heading, torso_direction(body.joints)), direction);
  const float angle = std::min(wanted, leans);
  if (!(angle > 0)) return;
  const Quat turn = axis_angle(Vec3{-direction.z, 0, direction.x}, angle);
  turn_upper_body(turn, body, joints, change);
}

namespace {

using enum HumanJoint;

// Radians from upright: an input that leans less than the first gets all of a style's lean, one
// that leans more than the second nothing.
constexpr float kUprightLean = 0.35f, kBentLean = 1.2f;
constexpr float kLowHead = 0.25f, kHighHead = 0.5f;  // Metres; 1.5 where the body stands.

constexpr float kRounding = 1e-3f;  // Radians: below it nothing changes at all.

float lean(Vec3 torso) { return arc_tangent(std::hypot(torso.x, torso.z), torso.y); }

}  // namespace

float share_above_floor(const HumanPositions& world) noexcept {
  return smooth_step((world[index(head)].y - kLowHead) / (kHighHead - kLowHead));
}

void limit_fold(const HeadingBody& body, float amount, HumanPositions& joints,
                BodyChange& change) noexcept {
  const float own = lean(torso_direction(body.joints));
  if (own <= kUprightLean) return;
  const Vec3 now = torso_direction(joints);
  const float added = lean(now) - own - kRounding;
  const float back =
      amount * added * smooth_step((own - kUprightLean) / (kBentLean - kUprightLean));
  if (!(back > 0)) return;
  const Quat turn = axis_angle(normalized(cross(now, Vec3{0, 1, 0})), back);
  turn_upper_body(turn, body, joints, change);
}

}  // namespace panache
