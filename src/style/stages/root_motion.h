#pragma once
// The style's change of the root motion, also on ground that is not flat.

#include <array>
#include <cstdint>

#include "base/vec.h"
#include "pose/contacts.h"
#include "pose/observer.h"
#include "pose/style_delta.h"
#include "rig/humanoid.h"
#include "style/stages/step_time.h"
#include "style/stages/window.h"

namespace panache {

// A body that goes less far up a slope, or stairs, gets less high. Measures the ground between the
// input's plants, and gives the height of the ground under the changed path over that under the
// input's. Exactly zero until two steps in a row go up, or down, by more than flat ground allows: a
// single foot that is put on something is no slope.
class Climb {
 public:
  void reset() noexcept { *this = Climb(); }
  // `body`: the input; `offset`: the style's change of the path so far, world, metres, y = 0.
  void step(const BodyPose& body, Vec3 offset, const StepTime& time) noexcept;
  float height() const noexcept { return height_; }  // Metres.

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.feet_), visit(self.plant_), visit(self.slope_), visit(self.offset_);
    visit(self.since_), visit(self.before_), visit(self.climb_), visit(self.wanted_);
    visit(self.height_), visit(self.planted_);
  }

 private:
  struct Foot {
    Vec3 toe;           // At the last step, world, metres.
    float still = 0;    // For so long, seconds,
    int32_t stood = 0;  // 1: so that it is planted. Not a bool: states have no padding.
  };
  void plant(Vec3 toe) noexcept;

  std::array<Foot, kFeet> feet_;
  Vec3 plant_;           // The last plant of a foot.
  Vec3 slope_;           // Of the ground there: climb per metre, along x and z; 0 if it is flat.
  Vec3 offset_;          // At the last step,
  Vec3 since_, before_;  // and its change since the last plant, and between the two before that.
  float climb_ = 0;      // Between those two, metres.
  float wanted_ = 0;     // Metres; `height_` follows it.
  float height_ = 0;
  int32_t planted_ = 0;  // 1: plant_ is known.
};

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
