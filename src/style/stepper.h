#pragma once
// A character's step around a source of change: before it the input is seen, after it the change is
// carried out.

#include <array>
#include <optional>

#include "base/prefetch.h"
#include "pose/observer.h"
#include "style/change_source.h"
#include "style/stages/flight.h"
#include "style/stages/window.h"
#include "style/stylizer_options.h"

namespace panache {

// When a pose is: how much of the input's own time passed since the last step, and how much of the
// viewer's. They are the same unless a play head runs through the input at another rate.
struct StepMoment {
  double input_seconds, output_seconds;
  // How much of a flight the pose is part of, see FlightWatch::amount(), where a play head has seen
  // poses to come. Otherwise the poses so far tell.
  std::optional<float> flight = {};
  double clip_seconds = 0;  // See StepTime::clip.
};

// The constructor allocates; nothing else does unless the source does, and nothing fails.
class Stepper {
 public:
  // `layout`: of the source's windows; `options` are in their ranges.
  Stepper(Rig rig, PoseLayout layout, const StylizerOptions& options);

  // Forgets the motion so far.
  void reset() noexcept;
  // Before the first step of a motion whose second pose is known: the first step then knows whether
  // the body moves. Later steps do not need it.
  void set_next(ConstPose next, double seconds) noexcept;
  // See Stylizer::step(). Returns what the source asked for; `clock` may be null.
  AskedChange step(ConstPose in, const StepMoment& moment, ChangeSource& source, Pose out,
                   StageClock* clock = nullptr) noexcept;

  // The two parts of a step, between which the source is asked. `room`: where the window is
  // written, InputWindow::kMaxNumbers.
  Seen take_in(ConstPose in, const StepMoment& moment, std::span<float> room,
               StageClock* clock) noexcept;
  void give_out(const AskedChange& asked, const Seen& seen, Pose out) noexcept;

  // At the last step; see Stylizer.
  double rate() const noexcept { return stages_.rate(); }
  std::span<const float, kFeet> contacts() const noexcept { return stages_.contacts(); }
  const BodyChange& change() const noexcept { return stages_.change(); }
  StageFacts stage_facts() const noexcept { return stages_.facts(); }
  const Rig& rig() const noexcept { return observer_.rig(); }

  // Asks the caches for the poses that the next window is made of.
  void fetch_poses(double seconds) const noexcept { window_.fetch_poses(seconds); }
  // Names what a step reads and writes outside this object, but for the poses of the window.
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
  void forget() noexcept;  // Of the motion so far, all but the observer's part.
  GesturePlayer::Ground ground() const noexcept;

  StageOptions options_;
  bool started_ = false;
  Observer observer_;
  InputWindow window_;
  ChangeStages stages_;
  FlightWatch flights_;
  float flight_ = 0;  // Of FlightWatch::amount(), at the last step.
  NextPose next_;     // By set_next(), for the first step; no time for none.
};

}  // namespace panache
