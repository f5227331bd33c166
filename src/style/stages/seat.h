#pragma once
// Whether something besides its feet holds the body up: a chair, a wall, its knees. A style then
// leaves hips and legs as they are, because it does not know what they rest on, and acts on the
// torso, the head and the arms.

#include "rig/humanoid.h"
#include "style/stages/step_time.h"

namespace panache {

class SeatWatch {
 public:
  void reset() noexcept { *this = {}; }
  // `world`: canonical joints of the input, metres, floor at 0.
  void step(const HumanPositions& world, const StepTime& time) noexcept;
  // 0 where the feet hold the body, 1 where it sits, kneels or leans; eases in and out.
  float amount() const noexcept { return amount_; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.hips_), visit(self.speed_), visit(self.amount_);
  }

 private:
  Vec3 hips_;        // At the last step.
  float speed_ = 0;  // Of the hips, smoothed, m/s.
  float amount_ = 0;
};

}  // namespace panache
