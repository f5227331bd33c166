#pragma once
// Timing of the stages of a step.

#include <cstddef>

namespace panache {

// The number of a stage in kStageNames (style/stages/change_stages.h): these, then the row of
// stages, then the writing of the pose.
enum class Stage : size_t {
  observe,    // Observer
  window,     // InputWindow
  strengths,  // EasedStrengths
  networks,   // StyleNetworks
  first_of_row,
};

// Is notified when each stage of a step is done.
class StageClock {
 public:
  virtual ~StageClock() = default;
  virtual void done(Stage stage) noexcept = 0;
};

// `clock` may be null.
inline void tell(StageClock* clock, Stage stage) noexcept {
  if (clock) clock->done(stage);
}

}  // namespace panache
