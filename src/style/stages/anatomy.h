#pragma once
// Seventh stage: no joint bends further than people can.

#include <array>

#include "pose/changed_joints.h"
#include "rig/rig.h"
#include "style/stages/step_time.h"

namespace panache {

// Takes back a share of what a change bends torso, neck, shoulders, elbows, wrists, hips and knees
// where that goes beyond the range of motion of people and the input itself does not: from nothing
// of it 10 degrees before the limit to nearly all. So a limb is always between where the input has
// it and where the style wants it. The shares come gradually, and go more slowly, so that nothing
// pops. Nor is a joint of legs or torso turned by more than 90 degrees beyond what it hangs on, as
// that would be another motion. Where a change leaves a joint as it is, this does, too, to the bit.
class Anatomy {
 public:
  void reset() noexcept { *this = {}; }
  void step(const HeadingBody& body, const Rig& rig, const StepTime& time,
            BodyChange& change) noexcept;
  // What it would take back at each hip joint: a foot that is held may turn a thigh further than
  // the style did.
  void watch_thighs(const HeadingBody& body, const StepTime& time,
                    const BodyChange& change) noexcept;
  // 0 to 1, eased, as last watched; left, right.
  float thigh_share(size_t side) const noexcept { return thighs_[side]; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.torso_), visit(self.neck_), visit(self.shoulders_), visit(self.elbows_);
    visit(self.wrists_), visit(self.hips_), visit(self.knees_), visit(self.thighs_);
  }

 private:
  // What is taken back at each joint, 0 to 1; of left and right.
  float torso_ = 0, neck_ = 0;
  std::array<float, 2> shoulders_{}, elbows_{}, wrists_{}, hips_{}, knees_{};
  std::array<float, 2> thighs_{};  // By watch_thighs().
};

}  // namespace panache
