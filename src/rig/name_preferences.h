#pragma once
// The standards' own names go before guesses by place: a joint that is called as VRM, Mixamo or
// Unreal call it takes the place of one that was found by where it hangs, unless hierarchy or mesh
// contradict the name; then a note says so. What is known beforehand stays, and nothing is
// preferred where the limbs are found by shape. Private to the folder.

#include "rig/mapping_draft.h"

namespace panache {

class NamePreferences {
 public:
  // Changes `draft`, which must outlive it.
  explicit NamePreferences(MappingDraft& draft) : draft_(draft) {}

  // Upper and lower parts of an arm and a leg, once all limbs are found. side: 0 left, 1 right.
  void limbs(size_t side);
  // Hips and chest, once they are found.
  void torso();
  // The neck, once torso and head are found.
  void neck();
  // The spine, once it is found.
  void spine();
  // A shoulder, once it and the neck are found. side: 0 left, 1 right.
  void shoulder(size_t side);
  // Names decide head, hands, feet and toes already: only notes where another joint has a
  // standard's own name for one of them.
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
