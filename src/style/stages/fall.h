#pragma once
// Styles do not affect free fall.

#include "rig/body_pose.h"
#include "style/stages/step_time.h"

namespace panache {

// While the body is in the air, what a style adds to its height stays what it was at take-off, so
// that it rises and falls as its input does; on the ground the height goes back to the style's.
class FreeFall {
 public:
  void reset() noexcept { *this = {}; }
  // `flight`: see FlightWatch::amount(). Adjusts the height of `change`; not at all where that
  // stays as it is.
  void step(float flight, const StepTime& time, BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.wanted_), visit(self.held_);
  }

 private:
  float wanted_ = 0;  // Height at the last step, before it was adjusted, metres,
  float held_ = 0;    // and what was added to it.
};

}  // namespace panache
