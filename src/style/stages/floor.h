#pragma once
// No toe, knee or seat below the floor, and no body above it.

#include "rig/body_pose.h"
#include "style/stages/step_time.h"

namespace panache {

// A style trained on one body may put another's feet through the floor, and the knees of a body
// that kneels: lifts the body by as much as its lowest toe is deeper than both the floor and the
// input's own lowest toe, or a knee or the hips deeper than they lie on the floor and than the
// input's. It comes and goes slowly, so that the body does not jerk at each step; the leg IK
// removes the remaining toe penetration. Legs that a style bends more than those of its own takes
// would hover: lowers the body by as much as its lowest toe is higher than the input's.
class FloorClearance {
 public:
  void reset() noexcept { lift_ = sink_wanted_ = sink_ = 0; }
  // `joints`: those of changed_joints(); `amount`: how much of a style is in force, and `carried`:
  // how much the feet carry the body, 0 to 1.
  void step(const BodyPose& body, const HumanPositions& joints, float amount, float carried,
            const StepTime& time, BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.lift_), visit(self.sink_wanted_), visit(self.sink_);
  }

 private:
  float lift_ = 0, sink_wanted_ = 0, sink_ = 0;  // Metres; the last one follows the wanted one.
};

}  // namespace panache
