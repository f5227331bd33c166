#include "rig/name_preferences.h"

#include <algorithm>

#include "rig/joint_name.h"
#include "rig/limbs.h"

namespace panache {

using enum HumanJoint;

void NamePreferences::limbs(size_t side) {
  const JointTree& tree = draft_.tree;
  for (const auto& both : kLimbNames) {
    const LimbNames& limb = both[side];
    const LimbNames& other = both[1 - side];
    const int other_tip = draft_.at(other.end) >= 0 ? draft_.at(other.end) : draft_.at(other.lower);
    if (draft_.at(limb.end) >= 0) {
      prefer(limb.lower, [&](int j) {
        return is_between(-1, j, draft_.at(limb.end)) && !tree.is_above(j, other_tip);
      });
    }
    prefer(limb.upper, [&](int j) {
      return is_between(-1, j, draft_.at(limb.lower)) && !tree.is_above(j, other_tip);
    });
  }
}

void NamePreferences::torso() {
  const int left_tip = draft_.arm_tips[0], right_tip = draft_.arm_tips[1];
  prefer(HumanJoint::hips, [&](int j) {
    return is_between(-1, j, draft_.at(left_upper_leg)) &&
           is_between(-1, j, draft_.at(right_upper_leg)) && draft_.tree.is_above(j, left_tip) &&
           draft_.tree.is_above(j, right_tip) && j != draft_.at(chest);
  });
  prefer_piece(chest, draft_.at(hips));
  prefer(chest, [&](int j) {
    return is_between(draft_.at(hips), j, left_tip) && is_between(draft_.at(hips), j, right_tip);
  });
}

void NamePreferences::neck() {
  prefer_piece(HumanJoint::neck, neck_base());
  prefer(HumanJoint::neck, [&](int j) { return is_between(neck_base(), j, draft_.at(head)); });
}

void NamePreferences::spine() {
  if (draft_.at(chest) < 0) return;
  prefer(HumanJoint::spine,
         [&](int j) { return is_between(draft_.at(hips), j, draft_.at(chest)); });
}

void NamePreferences::shoulder(size_t side) {
  prefer(side ? right_shoulder : left_shoulder, [&](int j) {
    return is_between(neck_base(), j, draft_.at(kLimbNames[0][side].upper)) &&
           !draft_.tree.is_above(j, draft_.arm_tips[1 - side]);
  });
}

void NamePreferences::note_ends() {
  for (const HumanJoint joint :
       {head, left_hand, right_hand, left_foot, right_foot, left_toes, right_toes}) {
    note_untaken(joint);
  }
}

// A joint with a standard name of `joint` replaces one that was found by its position and has none,
// if it fits into the hierarchy and the mesh does not follow only the other one.
template <class Fits>
void NamePreferences::prefer(HumanJoint joint, Fits fits) {
  if (is_settled(joint)) return;
  const int guess = draft_.at(joint);
  if (guess >= 0 && is_standard_name(draft_.names[guess])) return;
  int best = -1, misplaced = -1;
  for (int j = 0; j < draft_.tree.count(); ++j) {
    if (!is_standard_name_of(draft_.names[j], joint) || is_taken(j)) continue;
    if (!fits(j)) {
      misplaced = misplaced < 0 ? j : misplaced;
    } else if (best < 0 || draft_.joints[j].skin_weight > draft_.joints[best].skin_weight) {
      best = j;
    }
  }
  if (best < 0 && misplaced >= 0) return note_contradiction(joint, misplaced);
  if (best < 0) return;
  if (guess >= 0 && moves_less(best, guess)) return note_contradiction(joint, best);
  draft_.put(joint, best, "by its name", kCertain);
}

// Replaces a piece of torso or neck that was found by its position by the nearest piece above it,
// below `end`, with a standard name.
void NamePreferences::prefer_piece(HumanJoint joint, int end) {
  const int guess = draft_.at(joint);
  if (is_settled(joint) || guess < 0) return;
  if (is_standard_name(draft_.names[guess])) return;
  for (int q = draft_.tree.parent(guess); q >= 0 && q != end; q = draft_.tree.parent(q)) {
    if (!is_standard_piece_of(draft_.names[q], joint) || moves_less(q, guess)) continue;
    return draft_.put(joint, q, "by its name", kCertain);
  }
}

// Notes why a joint with a standard name of `joint` is not used.
void NamePreferences::note_contradiction(HumanJoint joint, int named) {
  const int taken = draft_.at(joint);
  if (taken < 0) return;
  draft_.map.notes.push_back(
      "'" + draft_.joints[named].name + "' is named as " + name_of(joint) + " and " +
      (moves_less(named, taken) ? "moves no mesh of its own" : "is not where that hangs") + ": '" +
      draft_.joints[taken].name + "' is taken");
}

// The same, if there is such an unused joint.
void NamePreferences::note_untaken(HumanJoint joint) {
  const int taken = draft_.at(joint);
  if (is_settled(joint) || taken < 0) return;
  if (is_standard_name_of(draft_.names[taken], joint)) return;
  for (int j = 0; j < draft_.tree.count(); ++j) {
    if (!is_standard_name_of(draft_.names[j], joint) || is_taken(j)) continue;
    // In line with it, without another reason: a palm, which is no contradiction.
    if (draft_.tree.is_above(taken, j) && !moves_less(j, taken)) continue;
    return note_contradiction(joint, j);
  }
}

// Whether names cannot change this joint.
bool NamePreferences::is_settled(HumanJoint joint) const {
  return draft_.by_shape || draft_.known.contains(index(joint));
}

bool NamePreferences::is_taken(int joint) const {
  const auto& taken = draft_.map.joint_of;
  return std::find(taken.begin(), taken.end(), joint) != taken.end();
}

// Whether `joint` is strictly below `above` and above `below`; -1: no limit.
bool NamePreferences::is_between(int above, int joint, int below) const {
  const JointTree& tree = draft_.tree;
  return (above < 0 || (joint != above && tree.is_above(above, joint))) &&
         (below < 0 || (joint != below && tree.is_above(joint, below)));
}

// Whether the mesh follows `other` and not `joint`.
bool NamePreferences::moves_less(int joint, int other) const {
  return draft_.tree.moves_mesh(other) && !draft_.tree.moves_mesh(joint);
}

// The joint that carries the neck.
int NamePreferences::neck_base() const {
  return draft_.at(chest) >= 0 ? draft_.at(chest) : draft_.at(hips);
}

}  // namespace panache
