#pragma once
// Eases strengths, sides and shape.

#include <span>
#include <vector>

#include "style/stages/shape.h"
#include "style/stages/step_time.h"

namespace panache {

// The effect of a strength. Posture grows linearly up to strength 2, so that the slider pushes as
// far as the body allows. Movement, tempo and contacts grow linearly up to 1, because twice the
// movement is another motion. Beyond, each unit counts kBeyondEven.
inline constexpr float kPostureEven = 2, kMovementEven = 1, kBeyondEven = 0.3f;
float posture_strength(float strength) noexcept;
float movement_strength(float strength) noexcept;

class EasedStrengths {
 public:
  // Strengths are clamped to -kMaxStrength to kMaxStrength.
  static constexpr float kMaxStrength = 4;

  EasedStrengths(size_t styles, float ease_seconds)
      : ease_seconds_(ease_seconds), now_(styles), sides_(styles, 1.0f) {}

  // Eases towards `strengths` [styles], `sides` [styles], -1 to 1, and `shape`. Strengths that are
  // not finite count as 0. A style that is off takes its side at once.
  void step(std::span<const float> strengths, std::span<const float> sides, const Shape& shape,
            const StepTime& time) noexcept;

  std::span<const float> now() const noexcept { return now_; }      // [styles]
  std::span<const float> sides() const noexcept { return sides_; }  // [styles]
  // Its dynamics also scale from posture_strength() to movement_strength().
  const Shape& shape() const noexcept { return active_shape_; }
  // How active any style is: 0 without one, 1 from a quarter strength on.
  float amount() const noexcept { return amount_; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.now_), visit(self.sides_), visit(self.shape_), visit(self.active_shape_),
        visit(self.amount_);
  }

 private:
  float ease_seconds_;
  std::vector<float> now_, sides_;  // [styles]
  Shape shape_, active_shape_;
  float amount_ = 0;
};

}  // namespace panache
