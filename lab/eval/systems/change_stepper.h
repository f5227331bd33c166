#pragma once
// A clip moved by somebody else's changes: everything of our step but the networks. So root motion,
// filter, anatomy, balance, floor, flights and feet are the same for all systems.

#include <vector>

#include "clip/clip.h"
#include "eval/systems/change_source.h"
#include "eval/test_input.h"
#include "pose/observer.h"
#include "style/stages/change_stages.h"
#include "style/stages/window.h"

namespace panache {

// One character.
class ChangeStepper {
 public:
  // `amount`: how much of any style is in force, 0 to 1, see EasedStrengths::amount().
  ChangeStepper(Rig rig, ChangeSource& source, float amount);

  // `frame`: of the source's take; `flight`: see FlightWatch::amount().
  void step(ConstPose in, float frame, float flight, double input_seconds, double output_seconds,
            Pose out);
  // Input seconds per output second that the source asks for, after the last step.
  double rate() const;

 private:
  void forget();

  ChangeSource& source_;
  float amount_, flight_ = 0;
  bool started_ = false;
  Observer observer_;
  InputWindow window_;
  ChangeStages stages_;
};

struct ChangedClip {
  Clip clip;                          // At the input's rate.
  std::vector<double> source_frames;  // Per frame of it, the input's frame (fractional).
};

// A whole clip; with `timing` the play head moves as the source asks, as in restyle().
ChangedClip change_clip(const TestInput& input, ChangeSource& source, float amount, bool timing);

}  // namespace panache
