#pragma once
// Keeps feet at rest that rest in the input, and finds the height of the hips.

#include <array>
#include <cstdint>

#include "pose/changed_joints.h"
#include "pose/style_delta.h"
#include "rig/humanoid.h"
#include "style/stages/step_time.h"

namespace panache {

// Keeps toes, knees and seat from sinking into the floor, and the body from hovering.

// A style trained on one body may push another's feet, or its knees when kneeling, through the
// floor. Lifts the body by the depth of its lowest toe below both the floor and the input's lowest
// toe, or of a knee or the hips below both their resting height and the input's; the leg IK removes
// what is left of a toe's. If a style bends the legs more than in its own takes, the body would
// hover: lowers it by the height of its lowest toe above the input's, slowly, so that a hop stays
// one.
class FloorClearance {
 public:
  void reset() noexcept { sink_ = 0; }
  // How far to raise the hips, metres, not eased: FootStance moves them. `joints`:
  // changed_joints(); `amount`: how active any style is, `carried`: how much the feet carry the
  // body, both 0 to 1; `ground`: see Climb::height().
  float step(const BodyPose& body, const HumanPositions& joints, float amount, float carried,
             float ground, const StepTime& time, const BodyChange& change) noexcept;

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.sink_);
  }

 private:
  float sink_ = 0;  // How far the body is lowered, metres.
};

// On a standing body, a style learnt from steps outputs the mean of its stepping legs: feet in the
// air, on their toes, or turned out. While a foot of the input rests and the feet do not step, its
// heel and toe stay at the input's heights, lifted and turned no further than in the style's
// stance. The knee bends for that, and the hips sink if the leg is too short. What this and the
// floor need of the hips' height is one number with one filter: with a filter for each, joints jump
// more often.
class FootStance {
 public:
  void reset() noexcept { *this = {}; }
  // `joints`: changed_joints(); updated. `amount`: how active any style is, 0 to 1. `stepping`:
  // StepWatch::amount(). `lift`: of the ground under the changed path and of a gesture, metres.
  // `raised`: FloorClearance::step(). `flight`: FlightWatch::amount(); in the air no foot rests,
  // and the hips keep what was needed on the ground.
  void step(const HeadingBody& body, HumanPositions& joints, const Stance& stance, float amount,
            float stepping, float lift, float raised, float flight, const StepTime& time,
            BodyChange& change) noexcept;
  // How much each foot was held at its height at the last step, 0 to 1.
  std::span<const float, kFeet> held() const noexcept { return held_; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.feet_), visit(self.held_);
    visit(self.height_wanted_), visit(self.height_);
  }

 private:
  struct Foot {
    Vec3 ankle, toe;             // In the input at the last step; world, metres.
    float speed = 0;             // Of the faster one, smoothed, m/s.
    float wanted = 0, rest = 0;  // Whether it rests, 0 to 1: eased once, and twice.
    int32_t seen = 0;            // Whether a speed is known. Not a bool: states have no padding.
  };
  static void watch(const BodyPose& body, int f, const StepTime& time, Foot& foot) noexcept;
  // Moves the hips by `height`, eased, from where the style has them. Metres.
  void move_hips(float height, float gain, BodyChange& change) noexcept;

  std::array<Foot, kFeet> feet_;
  std::array<float, kFeet> held_{};
  float height_wanted_ = 0, height_ = 0;  // Metres: eased once, and twice.
};

}  // namespace panache
