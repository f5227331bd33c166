#pragma once
// Strengths and shape as they are in force, eased.

#include <span>
#include <vector>

#include "style/shape.h"
#include "style/stages/step_time.h"

namespace panache {

// How far a strength drives what a style changes. The posture grows evenly up to strength 2, so
// that the slider pushes as far as the body allows. Movement, tempo and contacts grow evenly up to
// 1, because twice the movement is another motion. Beyond, each unit counts kBeyondEven.
inline constexpr float kPostureEven = 2, kMovementEven = 1, kBeyondEven = 0.3f;
float posture_strength(float strength) noexcept;
float movement_strength(float strength) noexcept;

class EasedStrengths {
 public:
  // Strengths are held within -kMaxStrength to kMaxStrength.
  static constexpr float kMaxStrength = 4;

  EasedStrengths(size_t styles, float ease_seconds) : ease_seconds_(ease_seconds), now_(styles) {}

  // Goes towards what is asked for; numbers that are not finite count as 0. `strengths`: [styles].
  void step(std::span<const float> strengths, const Shape& shape, const StepTime& time) noexcept;

  std::span<const float> now() const noexcept { return now_; }  // [styles]
  // With dynamics that bring a change of posture_strength() back to movement_strength().
  const Shape& shape() const noexcept { return in_force_; }
  // How much any style is in force: 0 without one, 1 from a quarter strength on.
  float amount() const noexcept { return amount_; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.now_), visit(self.shape_), visit(self.in_force_), visit(self.amount_);
  }

 private:
  float ease_seconds_;
  std::vector<float> now_;  // [styles]
  Shape shape_, in_force_;
  float amount_ = 0;
};

}  // namespace panache
