#include "pose/limb.h"

#include <algorithm>
#include <cmath>

namespace panache {
namespace {

void add_turn(const LimbJoints& limb, const TwoBoneTurn& turn, BodyChange& change) {
  change.rotations[limb.root] = normalized(turn.upper * change.rotations[limb.root]);
  change.rotations[limb.middle] = normalized(turn.lower * change.rotations[limb.middle]);
}

// Applies the turn to joints and change.
void apply(const LimbJoints& limb, const TwoBoneTurn& turn, HumanPositions& joints,
           BodyChange& change) {
  Vec3 &middle = joints[limb.middle], &end = joints[limb.end];
  const Vec3 root = joints[limb.root], lower = end - middle;
  middle = root + rotate(turn.upper, middle - root);
  end = middle + rotate(turn.lower, lower);
  add_turn(limb, turn, change);
}

}  // namespace

Vec3 knee_direction(Vec3 ankle, Vec3 toe) noexcept {
  return normalized(toe - ankle) + Vec3{0, 0, 0.5f};
}

void turn_limb(const LimbJoints& limb, Vec3 target, Vec3 bend, HumanPositions& joints,
               BodyChange& change) noexcept {
  const TwoBoneTurn turn =
      two_bone_ik(joints[limb.root], joints[limb.middle], joints[limb.end], target, bend);
  apply(limb, turn, joints, change);
}

void aim_limb(const LimbJoints& limb, Vec3 target, Vec3 out, HumanPositions& joints,
              BodyChange& change) noexcept {
  const Vec3 root = joints[limb.root], middle = joints[limb.middle], end = joints[limb.end];
  const TwoBonePositions to = two_bone_positions(root, middle, end, target, out);
  apply(limb, two_bone_turn(root, middle, end, to), joints, change);
}

void reach_with_limb(const LimbJoints& limb, Vec3 target, HumanPositions& joints,
                     BodyChange& change) noexcept {
  const Vec3 bend = bend_of(joints[limb.root], joints[limb.middle], joints[limb.end], limb.hint);
  turn_limb(limb, target, bend, joints, change);
}

void move_joints(const LimbJoints& limb, const LimbMove& move, HumanPositions& joints) noexcept {
  Vec3 &middle = joints[limb.middle], &end = joints[limb.end];
  const Vec3 root = joints[limb.root], target = end + move.end;
  const Vec3 out = normalized(bend_of(root, middle + move.middle, target, limb.hint));
  const TwoBonePositions to = two_bone_positions(root, middle, end, target, out);
  middle = to.middle, end = to.end;
}

void move_limb(const LimbJoints& limb, const LimbMove& move, HumanPositions& joints,
               BodyChange& change) noexcept {
  const Vec3 root = joints[limb.root], middle = joints[limb.middle], end = joints[limb.end];
  move_joints(limb, move, joints);
  const TwoBonePositions to = {joints[limb.middle], joints[limb.end]};
  add_turn(limb, two_bone_turn(root, middle, end, to), change);
}

namespace {

// The last bit of a leg's reach takes a large turn of the knee: a leg never extends beyond this
// share of its length unless the style stretches it further.
constexpr float kMaxReach = 0.995f;
// The share for a knee that is bent by 140 degrees. A chain folds further only as far as the style
// folds it: with the ankle at the hip, the knee may go anywhere.
constexpr float kMinReach = 0.34f;

}  // namespace

TwoBonePositions two_bone_positions(Vec3 root, Vec3 middle, Vec3 end, Vec3 target,
                                    Vec3 out) noexcept {
  const float upper = length(middle - root), lower = length(end - middle);
  const Vec3 line = target - root;
  const float far = length(line);
  if (upper < 1e-5f || lower < 1e-5f || far < 1e-5f) return {middle, end};
  const float longest = std::max(length(end - root), kMaxReach * (upper + lower));
  const float shortest = std::abs(upper - lower) * 1.001f + 1e-4f;
  const float reach = std::clamp(far, std::min(shortest, longest), longest);
  const Vec3 axis = normalized(line);
  // Law of cosines: the middle's position along the line and its distance from it.
  const float along = (upper * upper - lower * lower + reach * reach) / (2 * reach);
  const float off = std::sqrt(std::max(0.0f, upper * upper - along * along));
  return {root + axis * along + out * off, root + axis * reach};
}

TwoBoneTurn two_bone_turn(Vec3 root, Vec3 middle, Vec3 end, const TwoBonePositions& to) noexcept {
  if (to.middle == middle && to.end == end) return {};
  TwoBoneTurn turn;
  turn.upper = rotation_between(normalized(middle - root), normalized(to.middle - root));
  turn.lower = rotation_between(normalized(end - middle), normalized(to.end - to.middle));
  return turn;
}

TwoBoneTurn two_bone_ik(Vec3 root, Vec3 middle, Vec3 end, Vec3 target, Vec3 bend) noexcept {
  // The middle stays in its half-plane: the bend turns along with the chain.
  const Vec3 axis = normalized(target - root);
  const Quat swing = rotation_between(normalized(end - root, axis), axis);
  const Vec3 out = normalized(rotate(swing, bend));
  const float whole = length(middle - root) + length(end - middle);
  const float lacks = std::min(length(end - root), kMinReach * whole) - length(target - root);
  if (lacks > 0) target += axis * lacks;
  return two_bone_turn(root, middle, end, two_bone_positions(root, middle, end, target, out));
}

Vec3 bend_of(Vec3 root, Vec3 middle, Vec3 end, Vec3 hint, float firm) noexcept {
  const Vec3 axis = normalized(end - root);
  Vec3 bend = across(middle - root, axis);
  if (firm > 0) bend += normalized(across(hint, axis)) * std::max(0.0f, firm - length(bend) / 2);
  return length(bend) < 1e-3f * length(middle - root) ? across(hint, axis) : bend;
}

}  // namespace panache
