#pragma once
// Limits how fast arms are corrected.

#include <array>

#include "rig/body_pose.h"
#include "style/stages/step_time.h"

namespace panache {

// The rotations of upper arm, lower arm and hand; left, right.
using ArmRotations = std::array<Quat, 6>;
ArmRotations arm_rotations(const BodyChange& change) noexcept;

// What contacts and the body make of an arm turns at a limited speed: the nearer a wrist comes to
// its shoulder, the faster its elbow would have to turn about both, up to half a turn in a frame.
class SteadyArms {
 public:
  void reset() noexcept { *this = {}; }
  // `before`: the rotations of `change` before these corrections.
  void step(const ArmRotations& before, const StepTime& time, BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.corrections_);
  }

 private:
  ArmRotations corrections_{};  // At the last step; heading frame.
};

}  // namespace panache
