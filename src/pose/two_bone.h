#pragma once
// Two-bone inverse kinematics: a chain of two straight parts that turns so that its end reaches for
// a target, after the law of cosines.

#include "base/quat.h"

namespace panache {

struct TwoBoneTurn {
  Quat upper, lower;  // To be applied on top of the upper and the lower joint's world rotation.
};
// `root`, `middle`, `end`: where hip, knee and ankle (or shoulder, elbow, wrist) are; any one
// space. A target beyond reach is approached as far as the chain's length allows. `bend`: to which
// side of the line from root to end the middle goes, of any length; it turns along with that line.
TwoBoneTurn two_bone_ik(Vec3 root, Vec3 middle, Vec3 end, Vec3 target, Vec3 bend) noexcept;
// Where such a chain has its middle and end then. `out`: to which side of the line from root to
// target the middle goes, unit, at a right angle to that line. A chain without length stays.
struct TwoBonePlaces {
  Vec3 middle, end;
};
TwoBonePlaces two_bone_places(Vec3 root, Vec3 middle, Vec3 end, Vec3 target, Vec3 out) noexcept;
TwoBoneTurn two_bone_turn(Vec3 root, Vec3 middle, Vec3 end, const TwoBonePlaces& to) noexcept;
// The side that the middle is on, or that of `hint` where the chain is straight. `firm`: a middle
// that is nearer than twice this to the line from root to end (metres) goes the more towards the
// hint, the nearer it is; two thirds of it on the wrong side do not make the chain bend that way.
Vec3 bend_of(Vec3 root, Vec3 middle, Vec3 end, Vec3 hint, float firm = 0) noexcept;

// The part of `v` at right angles to `axis`, which has length 1.
inline Vec3 across(Vec3 v, Vec3 axis) noexcept { return v - axis * dot(v, axis); }

}  // namespace panache
