#pragma once
// Finds hip, knee and ankle, or shoulder, elbow and wrist, in a chain of joints by the lengths
// between them. Private to the folder.

#include <array>
#include <string>
#include <vector>

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

}  // namespace panache
