#pragma once
// Keeps joints within the human range of motion.

#include <array>

#include "pose/changed_joints.h"
#include "rig/rig.h"
#include "style/stages/step_time.h"

namespace panache {

// Reduces a change of torso, neck, shoulders, elbows, wrists, hips and knees that exceeds the human
// range of motion while the input does not: by nothing 10 degrees before the limit, up to nearly
// all. A limb thus stays between its directions in the input and in the style. The reductions rise
// gradually and fall more slowly, so that nothing pops; thighs, whose excess is small then, go back
// at once. Joints of legs and torso turn by at most 90 degrees relative to their parents; more
// would be another motion. Unchanged joints stay identical.
class Anatomy {
 public:
  void reset() noexcept { *this = {}; }
  void step(const HeadingBody& body, const Rig& rig, const StepTime& time,
            BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.torso_), visit(self.neck_), visit(self.shoulders_), visit(self.elbows_);
    visit(self.wrists_), visit(self.hips_), visit(self.knees_);
  }

 private:
  // Reductions at each joint, 0 to 1; [left, right].
  float torso_ = 0, neck_ = 0;
  std::array<float, 2> shoulders_{}, elbows_{}, wrists_{}, hips_{}, knees_{};
};

// Turns the legs of `change`, whose feet are held, back towards `free`, the same change before
// that, as far as thighs and knees need it to stay within their range, and within a few frames.
// `released`: how far each leg was turned back at the last step, 0 to 1; it falls slowly, so that a
// leg at its limit does not flutter. Left, right.
void keep_held_legs(const HeadingBody& body, const BodyChange& free, const StepTime& time,
                    std::array<float, 2>& released, BodyChange& change) noexcept;

}  // namespace panache
