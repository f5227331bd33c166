#pragma once
// Fourth stage, after the networks: their outputs without jitter.

#include "pose/style_delta.h"
#include "style/stages/step_time.h"

namespace panache {

// One-pole filters on the change and on the tempo, never on the input. Numbers that are not finite
// count as 0.
class OutputFilter {
 public:
  explicit OutputFilter(float smoothing_seconds) : smoothing_seconds_(smoothing_seconds) {}

  void reset() noexcept { delta_ = {}, log_rate_ = 0; }
  void step(const StyleDelta& delta, float log_rate, const StepTime& time) noexcept;

  const StyleDelta& delta() const noexcept { return delta_; }
  float log_rate() const noexcept { return log_rate_; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.delta_), visit(self.log_rate_);
  }

 private:
  float smoothing_seconds_;
  StyleDelta delta_;
  float log_rate_ = 0;
};

}  // namespace panache
