#pragma once
// Holds planted feet where they landed, with two-bone inverse kinematics, and lets them creep
// slowly to where a style wants them. Causal: no look-ahead. HeldFeet (style/stages) runs it in
// each step.

#include <array>
#include <span>

#include "base/vec.h"
#include "pose/contacts.h"
#include "rig/humanoid.h"

namespace panache {

class FootLock {
 public:
  // Seconds since the last step: of input time, for the speed of the input's toe, and of the
  // viewer's time, for all visible motion. They differ by the style's tempo.
  struct Seconds {
    float input, output;
  };
  void reset() noexcept { feet_ = {}; }
  // Adjusts the legs of `change`, and raises toes below toe_floor() as far as the legs easily can.
  // `joints`: changed_joints() of body and change; `contacts`: probability that each foot is
  // planted, 0 to 1; `level`: how far each foot's height is already fixed, 0 to 1; `amount`: how
  // much of the correction to apply, 0 (none at all) to 1; `ground`: how much higher the ground is
  // under the changed feet than under the input's, metres.
  void step(const BodyPose& body, const HumanPositions& joints,
            std::span<const float, kFeet> contacts, std::span<const float, kFeet> level,
            float amount, float ground, Seconds seconds, BodyChange& change) noexcept;

  // Calls visit(member) for all state of a foot lock.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.feet_);
  }

 private:
  // Unseen: before the first step. Let go: slid in the input, free until it lifts.
  enum class State { unseen, free, planted, let_go };
  struct Foot {
    State state = State::unseen;
    Vec3 toe;     // World position of the toe, uncorrected, at the last step,
    Vec3 input;   // and in the input.
    Vec3 stood;   // The input's toe when the foot was planted.
    Vec3 anchor;  // World position of the planted toe, metres,
    Vec3 glide;   // and its velocity while it comes to rest, m/s.
    Vec3 offset;  // Current correction, world, metres; fades after release,
    Vec3 speed;   // m/s, without a jump in its velocity.
    Vec3 knee;    // Side of its knee, heading frame, unit; 0 if not moved.
  };
  // Plants, holds or releases a foot, setting its offset, which step() applies. Its toe is at
  // `input` and, with the change but uncorrected, at `toe` (world).
  static void follow(Foot& foot, Vec3 input, Vec3 toe, float contact, float ground,
                     Seconds time) noexcept;

  // The side of the knee of a leg whose foot is moved. `ahead`: where the foot points; `firm`: how
  // much a nearly straight knee follows it, 0 to 1.
  static Vec3 bend(Foot& foot, Vec3 hip, Vec3 knee, Vec3 ankle, Vec3 ahead, float firm,
                   float seconds) noexcept;

  std::array<Foot, kFeet> feet_;
};

}  // namespace panache
