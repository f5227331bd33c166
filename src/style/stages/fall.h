#pragma once
// Styles do not affect free fall.

#include "rig/body_pose.h"
#include "style/stages/step_time.h"

namespace panache {

// In the air, a style's change of the height keeps its value at take-off, so that the body rises
// and falls like its input; on the ground the height returns to the style's.
class FreeFall {
 public:
  void reset() noexcept { *this = {}; }
  // `flight`: see FlightWatch::amount(). Adjusts the height of `change`.
  void step(float flight, const StepTime& time, BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.wanted_), visit(self.held_);
  }

 private:
  float wanted_ = 0;  // Height at the last step, before it was adjusted, metres,
  float held_ = 0;    // and the adjustment.
};

}  // namespace panache
