#pragma once
// Finds arms and legs by the joints' names. Private to the folder.

#include <array>
#include <functional>
#include <map>
#include <span>
#include <vector>

#include "rig/humanoid.h"
#include "rig/joint_name.h"
#include "rig/limb_shape.h"

namespace panache {

// The human joints of a limb, from the torso down.
struct LimbNames {
  LimbKind kind;
  HumanJoint upper, lower, end;
};
// Arms, then legs; [left, right].
inline constexpr std::array<std::array<LimbNames, 2>, 2> kLimbNames = {
    {{{{LimbKind::arm, HumanJoint::left_upper_arm, HumanJoint::left_lower_arm,
        HumanJoint::left_hand},
       {LimbKind::arm, HumanJoint::right_upper_arm, HumanJoint::right_lower_arm,
        HumanJoint::right_hand}}},
     {{{LimbKind::leg, HumanJoint::left_upper_leg, HumanJoint::left_lower_leg,
        HumanJoint::left_foot},
       {LimbKind::leg, HumanJoint::right_upper_leg, HumanJoint::right_lower_leg,
        HumanJoint::right_foot}}}}};

// The joint on that side with the plainest name that `is` accepts: fewest further words, then
// nearest to the root, then first. Skips names for which is_near() holds, and joints for which
// `where` does not. -1 if there is none.
int find_named(
    const JointTree& tree, std::span<const JointName> names, Side side,
    bool (*is)(const JointName&), const std::function<bool(int)>& where = [](int) { return true; });

// The same, but a joint with a standard name of `joint` is preferred to plainer names, unless only
// the plainest moves a mesh.
int find_own_named(const JointTree& tree, std::span<const JointName> names, HumanJoint joint,
                   Side side, bool (*is)(const JointName&), const std::function<bool(int)>& where);

// Finds hands and feet by their names, the joints above them by the hierarchy. A missing hand
// leaves `end` -1 if a forearm is named. known: skeleton joints of human joints, which override
// names. Joints that are not found are added to `missing`.
Limbs find_limbs_by_name(const JointTree& tree, std::span<const JointName> names,
                         const std::map<int, int>& known, std::vector<HumanJoint>& missing);

}  // namespace panache
