#pragma once
// Finds arms and legs, by the names of joints (limbs_by_name.cpp) and by branching, symmetry,
// lengths and heights (limbs_by_shape.cpp); and their three joints in a chain, by the lengths
// between them. Private to the folder.

#include <array>
#include <functional>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "rig/humanoid.h"
#include "rig/joint_name.h"
#include "rig/joint_tree.h"

namespace panache {

enum class LimbKind { arm, leg };

// The three joints of a limb; -1 for missing ones.
struct Limb {
  int upper = -1, lower = -1;
  int end = -1;  // Hand or foot; -1 also if it is only an End Site of `lower`.
};

// The four limbs, [left, right].
struct Limbs {
  std::array<Limb, 2> arms, legs;
  std::string side_reason;    // How left and right were distinguished, for display.
  float confidence = 0;       // In arms and legs, 0 to 1.
  float side_confidence = 0;  // In left and right.
};
// The lowest existing joint of a limb.
inline int lowest_joint(const Limb& limb) { return limb.end >= 0 ? limb.end : limb.lower; }

// How unusual a limb is: the sum of squared deviations from usual human proportions, 0 for a usual
// limb, a few units for an unusual one. branch: the joint where it leaves the torso. `limb` has an
// upper and a lower joint; its end, if any, is below them.
float limb_oddity(const JointTree& tree, LimbKind kind, int branch, const Limb& limb);

// The lowest joint on the longest path down from `joint`.
int farthest_below(const JointTree& tree, int joint);

// The joints from below `branch` down to `tip`, without those that coincide with another or with
// the branch.
std::vector<int> limb_chain(const JointTree& tree, int branch, int tip);

// The limb of least oddity among the joints of a chain (from the torso down); `end`, if given, is
// the last of the chain and the limb's end. All -1 if the chain is too short or, without `end`,
// longer than any limb.
Limb usual_limb(const JointTree& tree, LimbKind kind, int branch, const std::vector<int>& chain,
                int end = -1);

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

// names[joints]: only their sides are used. Nothing if no two pairs of limbs look like arms and
// legs of a body that stands in some of the poses.
std::optional<Limbs> find_limbs_by_shape(const JointTree& tree, std::span<const JointName> names);

// How upright the body is with these limbs: the cosine between legs and torso, 1 for an upright
// body, negative if arms and legs are exchanged. The maximum over the poses.
float uprightness(const JointTree& tree, const std::array<Limb, 2>& arms,
                  const std::array<Limb, 2>& legs);

}  // namespace panache
