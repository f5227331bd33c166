#pragma once
// First stage of a step: strengths and shape as they are in force, eased.

#include <span>
#include <vector>

#include "style/shape.h"
#include "style/stages/step_time.h"

namespace panache {

class EasedStrengths {
 public:
  // Strengths are held within -kMaxStrength to kMaxStrength.
  static constexpr float kMaxStrength = 4;

  EasedStrengths(size_t styles, float ease_seconds) : ease_seconds_(ease_seconds), now_(styles) {}

  // Goes towards what is asked for; numbers that are not finite count as 0. `strengths`: [styles].
  void step(std::span<const float> strengths, const Shape& shape, const StepTime& time) noexcept;

  std::span<const float> now() const noexcept { return now_; }  // [styles]
  const Shape& shape() const noexcept { return shape_; }
  // How much any style is in force: 0 without one, 1 from a quarter strength on.
  float amount() const noexcept { return amount_; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.now_), visit(self.shape_), visit(self.amount_);
  }

 private:
  float ease_seconds_;
  std::vector<float> now_;  // [styles]
  Shape shape_;
  float amount_ = 0;
};

}  // namespace panache
