#pragma once
// No joint bends further than people can.

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

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.torso_), visit(self.neck_), visit(self.shoulders_), visit(self.elbows_);
    visit(self.wrists_), visit(self.hips_), visit(self.knees_);
  }

 private:
  // What is taken back at each joint, 0 to 1; of left and right.
  float torso_ = 0, neck_ = 0;
  std::array<float, 2> shoulders_{}, elbows_{}, wrists_{}, hips_{}, knees_{};
};

// What Anatomy would take back at each hip joint of a body whose feet are held: that may turn a
// thigh further than the style does.
class ThighWatch {
 public:
  void reset() noexcept { *this = {}; }
  void step(const HeadingBody& body, const StepTime& time, const BodyChange& change) noexcept;
  // 0 to 1, eased; left, right.
  float share(size_t side) const noexcept { return shares_[side]; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.shares_);
  }

 private:
  std::array<float, 2> shares_{};
};

}  // namespace panache
