#include "retarget/root_joint.h"

#include <algorithm>
#include <vector>

#include "rig/joint_name.h"
#include "rig/up_axis.h"

namespace panache {
namespace {

// The joints in the world, file axes and units.
struct Placed {
  std::vector<Quat> rotations;
  std::vector<Vec3> positions;

  Placed(const Skeleton& skeleton, ConstPose pose)
      : rotations(skeleton.joints.size()), positions(skeleton.joints.size()) {
    world_pose(skeleton, pose, {rotations, positions});
  }
};

Vec3 up_of(const Rig& rig) {
  return rotate(conjugate(turn_up(rig.up_axis()).value_or(Quat{})), Vec3{0, 1, 0});
}

Vec3 along_ground(Vec3 way, Vec3 up) { return way - up * dot(way, up); }

}  // namespace

int find_root_joint(const Clip& character, const Rig& rig) {
  const std::vector<Joint>& joints = character.skeleton.joints;
  const int hips = rig.joints()[index(HumanJoint::hips)];
  if (hips < 0 || !joints[hips].can_translate) return -1;
  const Placed rest(character.skeleton, rig.rest().pose(0));
  const Vec3 up = up_of(rig);
  const auto at = [&](HumanJoint joint) {
    const int found = rig.joints()[index(joint)];
    return found < 0 ? Vec3{} : rest.positions[found];
  };
  const float leg = length(at(HumanJoint::left_upper_leg) - at(HumanJoint::left_foot));
  int found = -1;
  for (int j = joints[hips].parent; j >= 0; j = joints[j].parent) {
    const bool is_root = joints[j].skin >= 0 || parse_joint_name(joints[j].name).has("root");
    const Vec3 to_hips = rest.positions[hips] - rest.positions[j];
    const bool on_floor =
        dot(to_hips, up) > 0.5f * leg && length(along_ground(to_hips, up)) < 0.3f * leg;
    if (is_root && on_floor && joints[j].can_translate) found = j;
  }
  return found;
}

}  // namespace panache
