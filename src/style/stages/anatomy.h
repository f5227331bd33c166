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
// gradually and fall more slowly, so that nothing pops. Joints of legs and torso turn by at most 90
// degrees relative to their parents; more would be another motion. Unchanged joints stay identical.
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

// The reduction that Anatomy would apply at each hip joint after the feet are held, which may turn
// a thigh further than the style does.
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
