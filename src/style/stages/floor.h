#pragma once
// Keeps toes, knees and seat from sinking into the floor, and the body from hovering.

#include "rig/body_pose.h"
#include "style/stages/step_time.h"

namespace panache {

// A style trained on one body may push another's feet, or its knees when kneeling, through the
// floor. Lifts the body by the depth of its lowest toe below both the floor and the input's lowest
// toe, or of a knee or the hips below both their resting height and the input's; the leg IK removes
// what is left of a toe's. If a style bends the legs more than in its own takes, the body would
// hover: lowers it by the height of its lowest toe above the input's, slowly, so that a hop stays
// one.
class FloorClearance {
 public:
  void reset() noexcept { sink_ = 0; }
  // How far to raise the hips, metres, not eased: FootStance moves them. `joints`:
  // changed_joints(); `amount`: how active any style is, `carried`: how much the feet carry the
  // body, both 0 to 1; `ground`: see Climb::height().
  float step(const BodyPose& body, const HumanPositions& joints, float amount, float carried,
             float ground, const StepTime& time, const BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.sink_);
  }

 private:
  float sink_ = 0;  // How far the body is lowered, metres.
};

}  // namespace panache
