#pragma once
// Keeps legs from going through each other.

#include <array>

#include "pose/changed_joints.h"
#include "style/stages/limb_pushes.h"

namespace panache {

// If a change puts a thigh or shin deeper into the other leg than in the input, or through it,
// knees and ankles move apart sideways: bent legs swivel about the line from hip to ankle, straight
// ones spread. Each leg moves by half. Standing legs do not cross, either. Otherwise the change
// stays identical.
class LegsApart {
 public:
  void reset() noexcept { *this = {}; }
  // `amount`: how active any style is, `stepping`: how much the feet step, `planted`: how much each
  // foot is held in place, all 0 to 1; `joints`: changed_joints() of `body` and `change`; updated.
  void step(const HeadingBody& body, float amount, float stepping, std::array<float, 2> planted,
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
