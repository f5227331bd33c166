#pragma once
// Moves an arm or a leg, two straight parts, by target positions of its middle and end: two-bone
// inverse kinematics by the law of cosines.

#include <algorithm>
#include <array>

#include "base/quat.h"
#include "pose/contacts.h"
#include "rig/humanoid.h"

namespace panache {

inline constexpr std::array<HumanJoint, 2> kUpperArms = {HumanJoint::left_upper_arm,
                                                         HumanJoint::right_upper_arm};
inline constexpr std::array<HumanJoint, 2> kLowerArms = {HumanJoint::left_lower_arm,
                                                         HumanJoint::right_lower_arm};
inline constexpr std::array<HumanJoint, 2> kHands = {HumanJoint::left_hand, HumanJoint::right_hand};

// From the nearest point of the line from `a` to `b`.
inline Vec3 from_line(Vec3 point, Vec3 a, Vec3 b) noexcept {
  const Vec3 along = b - a;
  const float squared = dot(along, along);
  const float t = squared > 0 ? std::clamp(dot(point - a, along) / squared, 0.0f, 1.0f) : 0.0f;
  return point - (a + along * t);
}

// `v` with its length beyond `free` compressed so that it stays below `max`.
inline Vec3 softly_bounded(Vec3 v, float free, float max) noexcept {
  const float far = length(v), over = far - free, room = max - free;
  if (!(over > 0)) return v;
  return v * ((free + over * room / (over + room)) / far);
}

// Whether the rig has a head: a missing one has the position of its parent.
inline bool has_head(const HumanPositions& joints) noexcept {
  constexpr float kShortest = 0.01f;  // Metres.
  return length(joints[index(HumanJoint::head)] - joints[index(HumanJoint::neck)]) > kShortest;
}

// The joints of a limb, and the side of its middle if it is straight.
struct LimbJoints {
  int root, middle, end;
  Vec3 hint;
};
inline LimbJoints arm_joints(int side) noexcept {
  return {index(kUpperArms[side]), index(kLowerArms[side]), index(kHands[side]), {0, -1, -0.5f}};
}
inline LimbJoints leg_joints(int side) noexcept {
  return {index(kUpperLegs[side]), index(kLowerLegs[side]), index(kAnkles[side]), {0, 0, 1}};
}

// The direction of a knee: that of the foot, or ahead if the foot points down. Heading frame.
Vec3 knee_direction(Vec3 ankle, Vec3 toe) noexcept;

// The moves of elbow or knee, and of wrist or ankle; metres, in the space of changed_joints().
struct LimbMove {
  Vec3 middle, end;
  friend constexpr bool operator==(LimbMove, LimbMove) = default;
};

// Turns a limb of `change` so that its end reaches `target`, as far as possible. `bend`: see
// two_bone_ik(). Hand or foot keeps its rotation. `joints`: changed_joints(); updates middle and
// end, but not their children.
void turn_limb(const LimbJoints& limb, Vec3 target, Vec3 bend, HumanPositions& joints,
               BodyChange& change) noexcept;
// The same; the middle goes to the side `out`, unit, at a right angle to the line from the root to
// `target`.
void aim_limb(const LimbJoints& limb, Vec3 target, Vec3 out, HumanPositions& joints,
              BodyChange& change) noexcept;
// The same; the middle stays on its side of the limb.
void reach_with_limb(const LimbJoints& limb, Vec3 target, HumanPositions& joints,
                     BodyChange& change) noexcept;
// The same; the middle moves as closely as possible to `move`.
void move_limb(const LimbJoints& limb, const LimbMove& move, HumanPositions& joints,
               BodyChange& change) noexcept;
// The same for the joints only.
void move_joints(const LimbJoints& limb, const LimbMove& move, HumanPositions& joints) noexcept;

struct TwoBoneTurn {
  Quat upper, lower;  // To be applied on top of the upper and the lower joint's world rotation.
};
// `root`, `middle`, `end`: hip, knee and ankle (or shoulder, elbow, wrist), in any common space. A
// target beyond reach is approached as far as the chain's length allows. `bend`: the side of the
// line from root to end to which the middle goes, of any length; it turns along with that line.
TwoBoneTurn two_bone_ik(Vec3 root, Vec3 middle, Vec3 end, Vec3 target, Vec3 bend) noexcept;
// The resulting positions of middle and end. `out`: the side of the line from root to target to
// which the middle goes, unit, at a right angle to that line. A chain without length stays.
struct TwoBonePositions {
  Vec3 middle, end;
};
TwoBonePositions two_bone_positions(Vec3 root, Vec3 middle, Vec3 end, Vec3 target,
                                    Vec3 out) noexcept;
TwoBoneTurn two_bone_turn(Vec3 root, Vec3 middle, Vec3 end, const TwoBonePositions& to) noexcept;
// The side of the middle, or that of `hint` if the chain is straight. `firm`: a middle nearer than
// twice this to the line from root to end (metres) moves towards the hint, the nearer the more; up
// to two thirds of `firm` on the wrong side do not make the chain bend that way.
Vec3 bend_of(Vec3 root, Vec3 middle, Vec3 end, Vec3 hint, float firm = 0) noexcept;

// The part of `v` at right angles to `axis`, which has length 1.
inline Vec3 across(Vec3 v, Vec3 axis) noexcept { return v - axis * dot(v, axis); }

}  // namespace panache
