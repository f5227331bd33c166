#pragma once
// Keeps forearms and hands out of torso and head.

#include <array>

#include "pose/changed_joints.h"
#include "pose/hand_contacts.h"
#include "style/stages/limb_pushes.h"

namespace panache {

// If a change puts a forearm or hand deeper into torso or head than in the input, elbow and wrist
// are pushed out. Otherwise the change stays identical.
class ArmsClear {
 public:
  void reset() noexcept { *this = {}; }
  // A held wrist stays and its elbow moves; hands that hold each other move together. `amounts`:
  // how active any style is for the left and the right arm, 0 to 1; `joints`: changed_joints() of
  // `body` and `change`; updates the arms.
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
