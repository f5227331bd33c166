#include "style/stepper.h"

#include <algorithm>

#include "base/elementary.h"
#include "pose/contacts.h"

namespace panache {

Stepper::Stepper(Rig rig, PoseLayout layout, const StylizerOptions& options)
    : options_{options.root, options.foot_lock, options.tempo_everywhere},
      observer_(std::move(rig), options.max_speed),
      window_(layout),
      stages_(options.smoothing_seconds) {}

void Stepper::reset() noexcept {
  observer_.reset();
  forget();
}

void Stepper::forget() noexcept {
  started_ = false;
  window_.reset();
  stages_.reset();
  flights_.reset();
  flight_ = 0;
}

NextPose Stepper::see_next(ConstPose next, double seconds) noexcept {
  reset();
  observer_.observe(next, 0);
  const NextPose second = {observer_.now().world.positions, static_cast<float>(seconds)};
  observer_.reset();
  return second;
}

AskedChange Stepper::step(ConstPose in, const StepMoment& moment, ChangeSource& source, Pose out,
                          StageClock* clock) noexcept {
  std::array<float, InputWindow::kMaxNumbers> room;
  const SourceInput input = take_in(in, moment, room, clock);
  const AskedChange asked = source.ask(input);
  give_out(asked, input, out);
  return asked;
}

GesturePlayer::Ground Stepper::ground() const noexcept {
  constexpr float kHeld = 0.5f, kOnFloor = 0.05f;  // Metres.
  constexpr float kWalks = 2, kRuns = 3;           // m/s.
  const bool seated = stages_.seated() > kHeld;
  const auto contacts = stages_.contacts();
  const bool planted = std::max(contacts[0], contacts[1]) > kHeld;
  return {seated || lowest_foot(observer_.now().world.positions) < kOnFloor, planted && !seated,
          flight_, smooth_step((window_.ground_speed() - kWalks) / (kRuns - kWalks))};
}

SourceInput Stepper::take_in(ConstPose in, const StepMoment& moment, std::span<float> room,
                             StageClock* clock) noexcept {
  const double input_seconds = bounded_seconds(moment.input_seconds);
  const double output_seconds = bounded_seconds(moment.output_seconds);
  if (output_seconds > Observer::kMaxGap) observer_.reset();
  if (!observer_.observe(in, input_seconds)) forget();
  tell(clock, Stage::observe);
  const StepTime time{input_seconds, static_cast<float>(output_seconds), !started_, moment.next,
                      moment.clip_seconds};
  const Observation& now = observer_.now();
  const std::span<const float> window = window_.step(now, time, room);
  flights_.push(window_.time(), now.world.positions);
  flight_ = moment.flight ? *moment.flight : flights_.amount(window_.time());
  tell(clock, Stage::window);
  return {window, &now.body_frame, time, ground(), clock};
}

void Stepper::give_out(const AskedChange& asked, const SourceInput& input, Pose out) noexcept {
  stages_.step(asked, options_, flight_, observer_, window_, input.time, input.clock);
  observer_.write(stages_.change(), out);
  tell(input.clock, kWriteStage);
  started_ = true;
}

}  // namespace panache
