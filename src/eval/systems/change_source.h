#pragma once
// What a comparison system answers with: the change of one instant, before root, feet and the other
// stages that all systems share.

#include <array>
#include <span>

#include "pose/contacts.h"
#include "pose/style_delta.h"

namespace panache {

struct StyleAnswer {
  StyleDelta change;
  float log_rate = 0;                   // Logarithm of input seconds per output second.
  std::array<float, kFeet> contacts{};  // Probability that each foot is planted.
};

// One character's answers, one instant after the other; it may keep what it answered.
class ChangeSource {
 public:
  virtual ~ChangeSource() = default;
  // The next instant does not continue the motion so far.
  virtual void reset() = 0;
  // `window`: as PoseHistory::window() gives it, in layout positions; `frame`: of the take that the
  // source was made for, fractional; `seconds`: of the output since the last answer.
  virtual StyleAnswer answer(std::span<const float> window, float frame, float seconds) = 0;
};

}  // namespace panache
