#pragma once
// What the input tells of itself: whether something besides the feet supports the body, and whether
// the feet step.

#include <array>

#include "pose/contacts.h"
#include "rig/humanoid.h"
#include "style/stages/step_time.h"

namespace panache {

// Detects whether something besides the feet supports the body: a chair, a wall, its knees. A style
// then leaves hips and legs unchanged, because it does not know their support, and affects only
// torso, head and arms.
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

// Detects whether the feet step. A style's tempo applies to its steps; a body that stands and
// talks, waits or works keeps the input's tempo.
class StepWatch {
 public:
  void reset() noexcept { *this = {}; }
  // `world`: canonical joints of the input, metres.
  void step(const HumanPositions& world, const StepTime& time) noexcept;
  // 0 while the feet stand, 1 while they walk or run; eased over half a second.
  float amount() const noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.feet_), visit(self.speed_), visit(self.seen_);
  }

 private:
  std::array<Vec3, kFeet> feet_{};  // At the last step.
  float speed_ = 0;                 // Sum of both over the ground, smoothed, m/s.
  bool seen_ = false;               // Whether a speed is known.
};

}  // namespace panache
