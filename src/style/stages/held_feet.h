#pragma once
// Holds planted feet in place, as far as hips and knees allow.

#include <array>

#include "pose/foot_lock.h"
#include "style/stages/anatomy.h"
#include "style/stages/legs_apart.h"
#include "style/stages/stage_work.h"

namespace panache {

class HeldFeet {
 public:
  void reset() noexcept { *this = {}; }
  // Writes contacts(), and the change and joints of `work`.
  void step(StageWork& work) noexcept;
  // Probability that each foot is planted and held, at the last step.
  std::span<const float, kFeet> contacts() const noexcept { return contacts_; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    FootLock::visit_state(self.lock_, visit);
    LegsApart::visit_state(self.legs_, visit);
    visit(self.contacts_), visit(self.released_);
  }

 private:
  // Where a leg was turned back, raises the toe out of the floor.
  void raise_released(StageWork& work) const noexcept;

  FootLock lock_;
  LegsApart legs_;  // Applied after the feet are held.
  std::array<float, kFeet> contacts_{};
  std::array<float, kFeet> released_{};  // See keep_held_legs().
};

}  // namespace panache
