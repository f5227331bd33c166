#include "pose/limb.h"
#include "pose/two_bone.h"

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

Vec3 knee_way(Vec3 ankle, Vec3 toe) noexcept { return normalized(toe - ankle) + Vec3{0, 0, 0.5f}; }

void turn_limb(const LimbJoints& limb, Vec3 target, Vec3 bend, HumanPositions& joints,
               BodyChange& change) noexcept {
  const TwoBoneTurn turn =
      two_bone_ik(joints[limb.root], joints[limb.middle], joints[limb.end], target, bend);
  apply(limb, turn, joints, change);
}

void aim_limb(const LimbJoints& limb, Vec3 target, Vec3 out, HumanPositions& joints,
              BodyChange& change) noexcept {
  const Vec3 root = joints[limb.root], middle = joints[limb.middle], end = joints[limb.end];
  const TwoBonePlaces to = two_bone_places(root, middle, end, target, out);
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
  const TwoBonePlaces to = two_bone_places(root, middle, end, target, out);
  middle = to.middle, end = to.end;
}

void move_limb(const LimbJoints& limb, const LimbMove& move, HumanPositions& joints,
               BodyChange& change) noexcept {
  const Vec3 root = joints[limb.root], middle = joints[limb.middle], end = joints[limb.end];
  move_joints(limb, move, joints);
  const TwoBonePlaces to = {joints[limb.middle], joints[limb.end]};
  add_turn(limb, two_bone_turn(root, middle, end, to), change);
}

}  // namespace panache
