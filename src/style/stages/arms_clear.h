#pragma once
// Keeps forearms and hands out of torso and head, and limits how fast arms are corrected.

#include <array>

#include "pose/contacts.h"
#include "pose/changed_joints.h"
#include "rig/humanoid.h"
#include "style/stages/limb_pushes.h"
#include "style/stages/step_time.h"

namespace panache {

// If a change puts a forearm or hand deeper into torso or head than in the input, elbow and wrist
// are pushed out. Otherwise the change stays identical.
class ArmsClear {
 public:
  void reset() noexcept { *this = {}; }
  // A held wrist stays and its elbow moves; hands that hold each other move together. `amounts`:
  // how active any style is for the left and the right arm, 0 to 1; `joints`: changed_joints() of
  // `body` and `change`; updates the arms.
  void step(const HeadingBody& body, std::array<float, 2> amounts, const HandHolds& holds,
            const StepTime& time, HumanPositions& joints, BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.moves_);
  }

 private:
  std::array<EasedMove, 2> moves_;  // Left, right.
};

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
