#include "pose/limb.h"

namespace panache {

void turn_limb(const LimbJoints& limb, Vec3 target, Vec3 bend, HumanPositions& joints,
               BodyChange& change) noexcept {
  Vec3 &middle = joints[limb.middle], &end = joints[limb.end];
  const Vec3 root = joints[limb.root], lower = end - middle;
  const TwoBoneTurn turn = two_bone_ik(root, middle, end, target, bend);
  middle = root + rotate(turn.upper, middle - root);
  end = middle + rotate(turn.lower, lower);
  change.rotations[limb.root] = normalized(turn.upper * change.rotations[limb.root]);
  change.rotations[limb.middle] = normalized(turn.lower * change.rotations[limb.middle]);
}

void reach_with_limb(const LimbJoints& limb, Vec3 target, HumanPositions& joints,
                     BodyChange& change) noexcept {
  const Vec3 bend = bend_of(joints[limb.root], joints[limb.middle], joints[limb.end], limb.hint);
  turn_limb(limb, target, bend, joints, change);
}

void move_limb(const LimbJoints& limb, const LimbMove& move, HumanPositions& joints,
               BodyChange& change) noexcept {
  const Vec3 root = joints[limb.root], end = joints[limb.end], target = end + move.end;
  const Vec3 bend = bend_of(root, joints[limb.middle] + move.middle, target, limb.hint);
  // As it is seen from where the end still is.
  const Quat swing = rotation_between(normalized(end - root), normalized(target - root));
  turn_limb(limb, target, rotate(conjugate(swing), bend), joints, change);
}

}  // namespace panache
