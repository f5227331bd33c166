#pragma once
// Seventh stage: no joint bends further than people can.

#include <array>

#include "rig/body_pose.h"
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
  void reset() noexcept { shares_ = {}, thigh_shares_ = {}; }
  void step(const BodyPose& body, const Rig& rig, const StepTime& time,
            BodyChange& change) noexcept;
  // What it would take back at each hip joint: a foot that is held may turn a thigh further than
  // the style did.
  void watch_thighs(const BodyPose& body, const Rig& rig, const StepTime& time,
                    const BodyChange& change) noexcept;
  // 0 to 1, eased, as last watched; left, right.
  float thigh_share(size_t side) const noexcept { return thigh_shares_[side]; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.shares_), visit(self.thigh_shares_);
  }

 private:
  // Of torso, neck, then shoulder, elbow, wrist and hip, knee of either side: 0 to 1.
  std::array<float, 12> shares_{};
  std::array<float, 2> thigh_shares_{};  // Of left and right in watch_thighs().
};

}  // namespace panache
