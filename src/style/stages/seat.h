#pragma once
// Detects whether something besides the feet supports the body: a chair, a wall, its knees. A style
// then leaves hips and legs unchanged, because it does not know their support, and affects only
// torso, head and arms.

#include "rig/humanoid.h"
#include "style/stages/step_time.h"

namespace panache {

class SeatWatch {
 public:
  void reset() noexcept { *this = {}; }
  // `world`: canonical joints of the input, metres, floor at 0.
  void step(const HumanPositions& world, const StepTime& time) noexcept;
  // 0 if the feet support the body, 1 if it sits, kneels or leans; eased.
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
