#pragma once
// Two-bone inverse kinematics by the law of cosines: turns a chain of two straight parts so that
// its end reaches a target.

#include "base/quat.h"

namespace panache {

struct TwoBoneTurn {
  Quat upper, lower;  // To be applied on top of the upper and the lower joint's world rotation.
};
// `root`, `middle`, `end`: hip, knee and ankle (or shoulder, elbow, wrist), in any common space. A
// target beyond reach is approached as far as the chain's length allows. `bend`: the side of the
// line from root to end to which the middle goes, of any length; it turns along with that line.
TwoBoneTurn two_bone_ik(Vec3 root, Vec3 middle, Vec3 end, Vec3 target, Vec3 bend) noexcept;
// The resulting positions of middle and end. `out`: the side of the line from root to target to
// which the middle goes, unit, at a right angle to that line. A chain without length stays.
struct TwoBonePlaces {
  Vec3 middle, end;
};
TwoBonePlaces two_bone_places(Vec3 root, Vec3 middle, Vec3 end, Vec3 target, Vec3 out) noexcept;
TwoBoneTurn two_bone_turn(Vec3 root, Vec3 middle, Vec3 end, const TwoBonePlaces& to) noexcept;
// The side of the middle, or that of `hint` if the chain is straight. `firm`: a middle nearer than
// twice this to the line from root to end (metres) moves towards the hint, the nearer the more; up
// to two thirds of `firm` on the wrong side do not make the chain bend that way.
Vec3 bend_of(Vec3 root, Vec3 middle, Vec3 end, Vec3 hint, float firm = 0) noexcept;

// The part of `v` at right angles to `axis`, which has length 1.
inline Vec3 across(Vec3 v, Vec3 axis) noexcept { return v - axis * dot(v, axis); }

}  // namespace panache
