#pragma once
// From calm to lively: keeps less, or more, of the input's own movement of torso, head and arms.

#include <array>

#include "base/quat.h"
#include "pose/changed_joints.h"
#include "rig/humanoid.h"
#include "style/stages/step_time.h"

namespace panache {

// Moves the directions of neck and arms and the orientation of the chest, in the heading frame,
// towards their mean over the last seconds or away from it. Hips and legs keep their movement, and
// with them feet, contacts and course; the head keeps its turns to the sides. Does nothing while
// the energy is 1.
class Energy {
 public:
  void reset() noexcept { *this = {}; }
  // energy: 0 keeps the mean alone, 1 everything as it is, 2 twice the movement, within limits;
  // `share`: how much of this effect, 0 to 1. Changes the input below the style's change in
  // `change`.
  void step(const HeadingBody& body, float energy, float share, const StepTime& time,
            BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.runs_), visit(self.chest_), visit(self.limbs_);
  }

 private:
  static constexpr size_t kLimbs = 5;  // Neck, upper arms and forearms.

  bool runs_ = false;
  Quat chest_;  // Means.
  std::array<Vec3, kLimbs> limbs_{};
};

}  // namespace panache
