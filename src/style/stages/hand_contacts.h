#pragma once
// Hands keep what they touch in the input.

#include <array>
#include <cstdint>

#include "pose/changed_joints.h"
#include "pose/hand_contacts.h"
#include "style/stages/reach.h"
#include "style/stages/step_time.h"

namespace panache {

// Where a wrist is near the other wrist, the head, the hips or a thigh in the input, the arm
// reaches so that it is as far from there with the change as in the input. A contact eases in and
// out with the distance in the input and over time. Hands on hips and thighs must also rest there,
// by arms that do not just hang. The rest of the body keeps its style, as do the elbows' sides.
// Without a contact this changes nothing, to the bit.
class HandContacts {
 public:
  void reset() noexcept { *this = {}; }
  // `joints`: changed_joints() of `body` and `change`, of which it keeps up the arms; `amounts`:
  // how much of a style is in force, 0 to 1, for the left and the right arm.
  void step(const HeadingBody& body, std::array<float, 2> amounts, const StepTime& time,
            HumanPositions& joints, BodyChange& change) noexcept;

  // How much each hand keeps a contact at the last step.
  HandHolds holds() const noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.hands_), visit(self.holds_), visit(self.places_), visit(self.speeds_);
    visit(self.elbows_);
  }

 private:
  // The parts that a wrist can touch, besides the other wrist.
  enum Part { head, hips, left_thigh, right_thigh };
  static constexpr int kParts = 4;
  using Holds = std::array<std::array<float, kParts>, 2>;  // [sides][parts]

  void watch(const BodyPose& body, const StepTime& time) noexcept;

  float hands_ = 0;  // Of wrists that are near each other, 0 to 1, eased.
  Holds holds_{};    // Of the others, likewise.
  // Where each wrist is from hips, left and right thigh in the input, world, metres; at the last
  // step, and how fast that changes, m/s.
  std::array<std::array<Vec3, 3>, 2> places_{};
  std::array<std::array<float, 3>, 2> speeds_{};
  std::array<ArmSide, 2> elbows_{};
};

}  // namespace panache
