#pragma once
// A mapping while it is found, and what it is found from. Private to the folder.

#include <array>
#include <string>
#include <utility>
#include <vector>

#include "clip/clip.h"
#include "rig/humanoid.h"
#include "rig/joint_name.h"
#include "rig/joint_tree.h"
#include "rig/mapping.h"

namespace panache {

constexpr float kCertain = 1;  // The confidence of what a name says.

inline std::string name_of(HumanJoint joint) { return std::string(human_joint_name(index(joint))); }

// Refers to what it is made of, which must outlive it.
struct MappingDraft {
  MappingDraft(const std::vector<Joint>& skeleton_joints, const JointTree& joint_tree,
               const std::vector<JointName>& joint_names, const KnownJoints& known_joints)
      : joints(skeleton_joints), tree(joint_tree), names(joint_names), known(known_joints) {
    map.joint_of.fill(-1);
    map.reasons.fill("missing");
  }

  // The skeleton joint that was found, or -1.
  int at(HumanJoint joint) const { return map.joint_of[index(joint)]; }
  // found: a skeleton joint; -1 changes nothing.
  void put(HumanJoint joint, int found, std::string reason, float confidence) {
    if (found < 0) return;
    map.joint_of[index(joint)] = found;
    map.reasons[index(joint)] = std::move(reason);
    map.confidence[index(joint)] = confidence;
  }

  const std::vector<Joint>& joints;
  const JointTree& tree;
  const std::vector<JointName>& names;  // [joints]
  const KnownJoints& known;
  std::array<int, 2> arm_tips = {-1, -1};  // The lowest known joint of each arm.
  bool by_shape = false;                   // Whether the limbs are found by shape, not by name.
  Mapping map;
};

}  // namespace panache
