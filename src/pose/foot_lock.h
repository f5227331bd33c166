#pragma once
// Holds planted feet where they landed, with two-bone inverse kinematics, and lets them creep
// slowly to where a style wants them to stand. Causal: no look-ahead.

#include <array>
#include <span>

#include "base/vec.h"
#include "pose/contacts.h"
#include "rig/body_pose.h"

namespace panache {

class FootLock {
 public:
  // Seconds since the last step: of the input's own time, by which the input's toe leaves or
  // stands, and of the viewer's, in which everything that is shown moves. A style's tempo tells
  // them apart.
  struct Seconds {
    float input, output;
  };
  void reset() noexcept { feet_ = {}; }
  // Adjusts the legs of `change`, and draws toes up that are below toe_floor() as far as the legs
  // can easily see to it. `joints`: changed_joints() of body and change; `contacts`: probability
  // that each foot is planted, 0 to 1; `level`: how much of its height is given already, 0 to 1;
  // `amount`: how much of the correction to apply, 0 (none at all) to 1.
  void step(const BodyPose& body, const HumanPositions& joints,
            std::span<const float, kFeet> contacts, std::span<const float, kFeet> level,
            float amount, Seconds seconds, BodyChange& change) noexcept;

  // From where the style wants a planted foot to where it stands, at the last step, world, metres:
  // of the foot that is further away; 0 where none is planted.
  Vec3 pull() const noexcept;

  // Calls visit(member) for everything that tells one foot lock from another.
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
    Vec3 stood;   // Where the input's toe was when the foot was planted.
    Vec3 anchor;  // World position of the planted toe, metres,
    Vec3 glide;   // and its velocity while it comes to rest, m/s.
    Vec3 offset;  // World correction in force, metres; fades after release,
    Vec3 speed;   // m/s, without a jump in its velocity.
    Vec3 knee;    // To which side its knee went, heading frame, length 1; 0 if it was not moved.
  };
  // Follows one foot whose toe is at `input`, and at `toe` with the change, uncorrected (world).
  static void follow(Foot& foot, Vec3 input, Vec3 toe, float contact, Seconds time) noexcept;

  // To which side the knee of a leg goes whose foot is moved. `ahead`: where the foot points;
  // `firm`: how much a nearly straight knee goes there, 0 to 1.
  static Vec3 bend(Foot& foot, Vec3 hip, Vec3 knee, Vec3 ankle, Vec3 ahead, float firm,
                   float seconds) noexcept;

  std::array<Foot, kFeet> feet_;
};

}  // namespace panache
