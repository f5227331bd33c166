#pragma once
// What a comparison system answers with: the change of one instant, which the stages that all
// systems share then carry out.

#include <span>

#include "style/stages/change_stages.h"

namespace panache {

// One character's answers, one instant after the other; it may keep what it answered.
class ChangeSource {
 public:
  virtual ~ChangeSource() = default;
  // The next instant does not continue the motion so far.
  virtual void reset() = 0;
  // `window`: as PoseHistory::window() gives it, in layout positions; `frame`: of the take that the
  // source was made for, fractional; `seconds`: of the output since the last answer.
  virtual AskedChange answer(std::span<const float> window, float frame, float seconds) = 0;
};

}  // namespace panache
