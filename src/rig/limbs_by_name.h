#pragma once
// Arms and legs of a skeleton by its joints' names. Private to the folder.

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

// Of the joints of that side whose names `is` accepts, that are near nothing else and for which
// `where` holds, the plainest: fewest words besides, then nearest to the root, then first. -1 where
// there is none.
int find_named(
    const JointTree& tree, std::span<const JointName> names, Side side,
    bool (*is)(const JointName&), const std::function<bool(int)>& where = [](int) { return true; });

// The same, but a joint that has the standards' own name for `joint` goes before plainer ones,
// unless a mesh follows the plainest and not that one.
int find_own_named(const JointTree& tree, std::span<const JointName> names, HumanJoint joint,
                   Side side, bool (*is)(const JointName&), const std::function<bool(int)>& where);

// Hands and feet by their names, what is above them by the tree. A missing hand leaves `end` -1
// where a forearm is named. known: skeleton joints of human joints, which go before names. What was
// not found is added to `missing`; the result then lacks it.
Limbs find_limbs_by_name(const JointTree& tree, std::span<const JointName> names,
                         const std::map<int, int>& known, std::vector<HumanJoint>& missing);

}  // namespace panache
