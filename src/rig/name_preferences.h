#pragma once
// Prefers standard names to guesses by hierarchy: a joint with a VRM, Mixamo or Unreal name
// replaces one that was found by its position in the hierarchy, unless hierarchy or mesh contradict
// the name; then a note says so. Given joints stay, and nothing changes if the limbs were found by
// shape. Private to the folder.

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

// A mapping in progress and its inputs.
constexpr float kCertain = 1;  // The confidence of a name.

inline std::string name_of(HumanJoint joint) { return std::string(human_joint_name(index(joint))); }

// Refers to its arguments, which must outlive it.
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

class NamePreferences {
 public:
  // Changes `draft`, which must outlive it.
  explicit NamePreferences(MappingDraft& draft) : draft_(draft) {}

  // Upper and lower parts of an arm and a leg, after all limbs are found. side: 0 left, 1 right.
  void limbs(size_t side);
  // Hips and chest, once they are found.
  void torso();
  // The neck, once torso and head are found.
  void neck();
  // The spine, once it is found.
  void spine();
  // A shoulder, once it and the neck are found. side: 0 left, 1 right.
  void shoulder(size_t side);
  // Head, hands, feet and toes were found by name: only adds notes if another joint has a standard
  // name of one of them.
  void note_ends();

 private:
  template <class Fits>
  void prefer(HumanJoint joint, Fits fits);
  void prefer_piece(HumanJoint joint, int end);
  void note_contradiction(HumanJoint joint, int named);
  void note_untaken(HumanJoint joint);
  bool is_settled(HumanJoint joint) const;
  bool is_taken(int joint) const;
  bool is_between(int above, int joint, int below) const;
  bool moves_less(int joint, int other) const;
  int neck_base() const;

  MappingDraft& draft_;
};

}  // namespace panache
