#pragma once
// Smooths the outputs of the networks.

#include <array>

#include "pose/style_delta.h"
#include "style/stages/shape.h"
#include "style/stages/step_time.h"

namespace panache {

// One-pole filters on the change and on the tempo, never on the input. Numbers that are not finite
// count as 0. On out-of-distribution motion, a change that would move legs, torso or an arm more
// than the input does is smoothed up to eleven times as long: calm motion stays calm.
class OutputFilter {
 public:
  explicit OutputFilter(float smoothing_seconds = 0) : smoothing_seconds_(smoothing_seconds) {}

  void reset() noexcept {
    delta_ = {}, log_rate_ = 0;
    gate_ = 1, speed_ = {}, added_speed_ = {};
  }
  // `gate`: how well the motion is known, 0 to 1; `body`: the input in the body frame, metres.
  void step(const StyleDelta& delta, float log_rate, float gate, const HumanPositions& body,
            const StepTime& time) noexcept;

  const StyleDelta& delta() const noexcept { return delta_; }
  float log_rate() const noexcept { return log_rate_; }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.delta_), visit(self.log_rate_);
    visit(self.body_), visit(self.gate_), visit(self.speed_), visit(self.added_speed_);
  }

 private:
  // The gains of the regions' filters at this step.
  std::array<float, kRegions> gains(const StyleDelta& delta, float gate, const HumanPositions& body,
                                    const StepTime& time) noexcept;

  float smoothing_seconds_;
  StyleDelta delta_;
  float log_rate_ = 0;
  HumanPositions body_{};  // At the last step.
  float gate_ = 1;         // Mean over a few seconds.
  // Mean speeds of each region's joints, m/s: in the input, and added by the change.
  std::array<float, kRegions> speed_{}, added_speed_{};
};

}  // namespace panache
