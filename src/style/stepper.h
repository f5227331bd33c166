#pragma once
// A character's step: observes the input, asks a source for the change and carries it out.

#include <array>

#include "base/prefetch.h"
#include "pose/observer.h"
#include "style/networks/change_source.h"
#include "style/stages/change_stages.h"
#include "style/stages/flight.h"
#include "style/stages/step_time.h"
#include "style/stages/window.h"
#include "style/stylizer_options.h"

namespace panache {

// Only the constructor allocates, unless the source does; nothing fails.
class Stepper {
 public:
  // `layout`: the layout of the source's windows; `options` must be in their ranges.
  Stepper(Rig rig, PoseLayout layout, const StylizerOptions& options);

  // See StylizerOptions; from the next step on.
  void set_tempo_everywhere(bool everywhere) noexcept { options_.tempo_everywhere = everywhere; }
  // Forgets the motion so far.
  void reset() noexcept;
  // For the moment of the first step of a motion, if its second pose is known: the step then knows
  // whether the body moves. Forgets the motion so far.
  NextPose see_next(ConstPose next, double seconds) noexcept;
  // See Stylizer::step(). Returns the source's request; `clock` may be null.
  AskedChange step(ConstPose in, const StepMoment& moment, ChangeSource& source, Pose out,
                   StageClock* clock = nullptr) noexcept;

  // The two parts of a step, before and after asking the source. `room`: memory for the window,
  // InputWindow::kMaxNumbers.
  SourceInput take_in(ConstPose in, const StepMoment& moment, std::span<float> room,
                      StageClock* clock) noexcept;
  void give_out(const AskedChange& asked, const SourceInput& input, Pose out) noexcept;

  // At the last step; see Stylizer.
  double rate() const noexcept { return stages_.rate(); }
  std::span<const float, kFeet> contacts() const noexcept { return stages_.contacts(); }
  const BodyChange& change() const noexcept { return stages_.change(); }
  StageFacts stage_facts() const noexcept { return stages_.facts(); }
  const Rig& rig() const noexcept { return observer_.rig(); }

  // Prefetches the poses of the next window.
  void fetch_poses(double seconds) const noexcept { window_.fetch_poses(seconds); }
  // Adds the memory that a step uses outside this object, except for the poses of the window.
  void add_memory(Prefetch& prefetch) const noexcept { observer_.add_memory(prefetch); }

  // Calls visit(member) for everything that tells one character from another.
  template <class Self, class Visit>
  static void visit_state(Self& self, Visit&& visit) {
    visit(self.started_), visit(self.flight_);
    FlightWatch::visit_state(self.flights_, visit);
    Observer::visit_state(self.observer_, visit);
    InputWindow::visit_state(self.window_, visit);
    ChangeStages::visit_state(self.stages_, visit);
  }

 private:
  void forget() noexcept;  // Forgets all but the observer.
  GesturePlayer::Ground ground() const noexcept;

  StageOptions options_;
  bool started_ = false;
  Observer observer_;
  InputWindow window_;
  ChangeStages stages_;
  FlightWatch flights_;
  float flight_ = 0;  // FlightWatch::amount() at the last step.
};

}  // namespace panache
