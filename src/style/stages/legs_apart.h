#pragma once
// No leg goes through the other.

#include <array>

#include "pose/changed_joints.h"
#include "style/stages/limb_pushes.h"

namespace panache {

// Where a change puts a thigh or a shin deeper into the other leg than the input has it, or through
// it, knees and ankles move apart across the hips: bent legs swivel about the line from hip to
// ankle, straight ones are spread. Each leg gives way by half. Legs that stand do not cross,
// either. Where they are further apart, or as near in the input, nothing changes, to the bit.
class LegsApart {
 public:
  void reset() noexcept { *this = {}; }
  // `amount`: how much of a style is in force, `stepping`: how much the feet step, 0 to 1;
  // `planted`: how much each foot is held where it is, 0 to 1; `joints`: changed_joints() of `body`
  // and `change`, which it keeps up.
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
