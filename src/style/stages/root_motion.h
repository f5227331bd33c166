#pragma once
// The style's change of the root motion.

#include "pose/observer.h"
#include "pose/style_delta.h"
#include "style/stages/climb.h"
#include "style/stages/step_time.h"
#include "style/stages/window.h"

namespace panache {

// A style may sway and turn within a step, but not leave the input's course: its sideways motion
// and turn fade with this time constant.
inline constexpr float kCourseSeconds = 1.5f;

// The root motion that a style has added since the start.
struct RootOffset {
  Vec3 translation;  // World, metres; y = 0 on flat ground.
  float turn = 0;    // About +y, radians.
};

// Integrates a style's changes of speed and heading.
class RootMotion {
 public:
  void reset() noexcept { *this = RootMotion(); }
  // `gate`: how well the motion is known, 0 to 1.
  void step(const StyleDelta& delta, float gate, const Observer& observer,
            const InputWindow& window, const StepTime& time) noexcept;
  RootOffset offset() const noexcept {
    return {drift_ + sway_ + Vec3{0, climb_.height(), 0}, turn_};
  }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.drift_), visit(self.sway_), visit(self.turn_);
    visit(self.mean_forward_), visit(self.mean_speed_);
    Climb::visit_state(self.climb_, visit);
  }

 private:
  Vec3 drift_;      // Along the way, world, metres;
  Vec3 sway_;       // to the side, likewise,
  float turn_ = 0;  // and to the heading, radians; both fade.
  // The input's mean speed over the last seconds, m/s: forward, and in any direction.
  float mean_forward_ = 0, mean_speed_ = 0;
  Climb climb_;
};

}  // namespace panache
