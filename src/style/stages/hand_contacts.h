#pragma once
// Hands keep what they touch in the input: which they keep, where their wrists belong, and the side
// of the elbow.

#include <array>
#include <cstdint>

#include "pose/contacts.h"
#include "pose/changed_joints.h"
#include "style/stages/step_time.h"

namespace panache {

// The side of an elbow, and the direction from shoulder to wrist: unit vectors, heading frame; 0
// without a contact.
struct ArmSide {
  Vec3 side, direction;
};

// Moves a wrist to `target`. The elbow keeps the style's side; the further the arm turns, the more
// it takes that of `elbow`, its position in the input, because a large turn makes the style's side
// arbitrary. `last` starts on the style's side, follows the arm, and turns about it towards the
// chosen side. `joints`: changed_joints() with `change`; updates the arm.
void reach(int side, Vec3 target, Vec3 elbow, const StepTime& time, ArmSide& last,
           HumanPositions& joints, BodyChange& change) noexcept;

// If a wrist is near the other wrist, the head, the hips or a thigh in the input, the arm keeps
// that distance in the changed pose. A contact eases in and out with the distance in the input and
// over time. Hands on hips and thighs must also rest there, and the arms must not just hang; as
// they are posture, a style that moves the arm away takes the hand along. The rest of the body and
// the side of the elbows keep the style. Without contacts nothing changes at all.
class HandContacts {
 public:
  void reset() noexcept { *this = {}; }
  // `firmness`: of all contacts, 0 to 1. `amounts`: how active any style is for the left and the
  // right arm, 0 to 1. `joints`: changed_joints() of `body` and `change`; updates the arms.
  void step(const HeadingBody& body, float firmness, std::array<float, 2> amounts,
            const StepTime& time, HumanPositions& joints, BodyChange& change) noexcept;

  // How much each hand keeps a contact at the last step.
  HandHolds holds() const noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.hands_), visit(self.holds_), visit(self.offsets_), visit(self.speeds_);
    visit(self.elbows_), visit(self.moved_);
  }

 private:
  // The parts that a wrist can touch, besides the other wrist.
  enum Part { head, hips, left_thigh, right_thigh };
  static constexpr int kParts = 4;
  using Holds = std::array<std::array<float, kParts>, 2>;  // [sides][parts]

  void watch(const BodyPose& body, float firmness, const StepTime& time) noexcept;
  // How much a wrist keeps its contact with a part of the body, 0 to 1.
  float hold(int side, int part) const noexcept;

  float hands_ = 0;  // Contact of the wrists, 0 to 1, eased.
  Holds holds_{};    // Other contacts, likewise.
  // Each wrist relative to hips, left and right thigh in the input, world, metres, at the last
  // step; and the speed of its change, m/s.
  std::array<std::array<Vec3, 3>, 2> offsets_{};
  std::array<std::array<float, 3>, 2> speeds_{};
  std::array<ArmSide, 2> elbows_{};
  // How far the style would move each wrist from the hips and thighs that it rests on, metres,
  // smoothed; negative without such a contact.
  std::array<float, 2> moved_ = {-1, -1};
};

}  // namespace panache
