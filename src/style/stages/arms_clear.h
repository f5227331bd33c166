#pragma once
// No forearm or hand goes through torso or head.

#include <array>

#include "pose/changed_joints.h"
#include "pose/hand_contacts.h"
#include "style/stages/limb_pushes.h"

namespace panache {

// Where a change puts a forearm or a hand deeper into torso or head than the input has it, elbow
// and wrist are pushed out. Where they are further away, or as deep in the input, nothing changes,
// to the bit.
class ArmsClear {
 public:
  void reset() noexcept { *this = {}; }
  // A wrist that is held stays, and its elbow gives way; hands that hold each other move together.
  // `amounts`: how much of a style is in force, 0 to 1, for the left and the right arm; `joints`:
  // changed_joints() of `body` and `change`, of which it keeps up the arms.
  void step(const HeadingBody& body, std::array<float, 2> amounts, const HandHolds& holds,
            const StepTime& time, HumanPositions& joints, BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.moves_);
  }

 private:
  std::array<EasedMove, 2> moves_;  // Left, right.
};

}  // namespace panache
