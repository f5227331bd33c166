#include "style/stylizer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "base/smooth_step.h"
#include "pose/contacts.h"
#include "style/state_bytes.h"

namespace panache {
namespace {

constexpr float kGateSeconds = 0.15f;  // Time constant of the gate.

}  // namespace

Result<Stylizer> Stylizer::create(std::shared_ptr<const Model> model, Rig rig,
                                  const StylizerOptions& options) {
  for (const float seconds : {options.ease_seconds, options.smoothing_seconds}) {
    if (!(seconds >= 0 && seconds <= 10)) {
      return Error{"stylizer option of " + std::to_string(seconds) +
                   " seconds; expected 0 to 10 seconds"};
    }
  }
  if (!(options.max_speed > 0)) {
    return Error{"max_speed of " + std::to_string(options.max_speed) +
                 " m/s; expected more than 0"};
  }
  if (!(options.gesture_rate >= 0 && options.gesture_rate <= GesturePlayer::kMaxRate)) {
    return Error{"gesture rate of " + std::to_string(options.gesture_rate) +
                 " per second; expected 0 to 10"};
  }
  return Stylizer(std::move(model), std::move(rig), options);
}

Stylizer::Stylizer(std::shared_ptr<const Model> model, Rig rig, const StylizerOptions& options)
    : options_(options),
      shape_(options.shape),
      observer_(std::move(rig), options.max_speed),
      strengths_(model->styles().size(), options.ease_seconds),
      window_(model->layout()),
      networks_(std::move(model)),
      stages_(options.smoothing_seconds),
      gestures_(options.gesture_seed) {}

void Stylizer::reset() noexcept {
  forget_motion();
  gestures_.reset(options_.gesture_seed);
}

void Stylizer::forget_motion() noexcept {
  observer_.reset();
  forget();
}

void Stylizer::add_memory(Prefetch& prefetch) const noexcept {
  prefetch.add(this, sizeof *this);
  observer_.add_memory(prefetch);
  networks_.add_memory(prefetch);
}

void Stylizer::forget() noexcept {
  started_ = false;
  window_.reset();
  stages_.reset();
  gestures_.stop();
  flights_.reset();
  flight_ = 0;
}

bool Stylizer::trigger(int style, int gesture) noexcept {
  if (style < 0 || static_cast<size_t>(style) >= model().styles().size()) return false;
  if (gesture < 0 || static_cast<size_t>(gesture) >= model().gestures(style).size()) return false;
  gestures_.trigger(style, gesture);
  return true;
}

GesturePlayer::Ground Stylizer::ground() const noexcept {
  constexpr float kHeld = 0.5f, kOnFloor = 0.05f;  // Metres.
  constexpr float kWalks = 2, kRuns = 3;           // m/s.
  const bool seated = stages_.seated() > kHeld;
  const auto contacts = stages_.contacts();
  const bool planted = std::max(contacts[0], contacts[1]) > kHeld;
  return {seated || lowest_foot(observer_.now().world.positions) < kOnFloor, planted && !seated,
          flight_, smooth_step((window_.ground_speed() - kWalks) / (kRuns - kWalks))};
}

void Stylizer::set_next(ConstPose next, double seconds) noexcept {
  reset();
  observer_.observe(next, 0);
  next_ = {observer_.now().world.positions, static_cast<float>(seconds)};
  observer_.reset();
}

void Stylizer::step(ConstPose in, std::span<const float> strengths, const StepMoment& moment,
                    Pose out) noexcept {
  step(in, strengths, moment, out, nullptr);
}

void Stylizer::step(ConstPose in, std::span<const float> strengths, double seconds, Pose out,
                    StageClock& clock) noexcept {
  step(in, strengths, {seconds, seconds}, out, &clock);
}

void Stylizer::step(ConstPose in, std::span<const float> strengths, const StepMoment& moment,
                    Pose out, StageClock* clock) noexcept {
  std::array<float, InputWindow::kMaxNumbers> room;
  const auto [time, pass] = take_in(in, strengths, moment, room, clock);
  networks_.forward(pass.window, pass.gate_share);
  tell(clock, Stage::networks);
  give_out(time, out, clock);
}

Stylizer::TakenIn Stylizer::take_in(ConstPose in, std::span<const float> strengths,
                                    const StepMoment& moment, std::span<float> room,
                                    StageClock* clock) noexcept {
  const double input_seconds = bounded_seconds(moment.input_seconds);
  const double output_seconds = bounded_seconds(moment.output_seconds);
  if (output_seconds > Observer::kMaxGap) observer_.reset();
  if (!observer_.observe(in, input_seconds)) forget();
  tell(clock, Stage::observe);

  const StepTime time{input_seconds, static_cast<float>(output_seconds), !started_,
                      next_.seconds > 0 ? &next_ : nullptr};
  strengths_.step(strengths, shape_, time);
  networks_.set_strengths(strengths_.now());
  tell(clock, Stage::strengths);
  const std::span<const float> window = window_.step(observer_.now(), time, room);
  flights_.push(window_.time(), observer_.now().world.positions);
  flight_ = moment.flight ? *moment.flight : flights_.amount(window_.time());
  tell(clock, Stage::window);
  return {time, {&networks_, window, time.gain(kGateSeconds)}};
}

void Stylizer::give_out(const StepTime& time, Pose out, StageClock* clock) noexcept {
  AskedChange asked;
  asked.delta =
      model().recipe().to_change(networks_.pose(), observer_.now().body_frame, window_.root());
  asked.log_rate = networks_.log_rate();
  std::ranges::copy(networks_.contact(), asked.contacts.begin());
  asked.gate = networks_.gate();
  asked.stance = networks_.stance();
  if (options_.gesture_rate > 0 || !gestures_.rests()) {
    gestures_.step(model(), strengths_.now(), options_.gesture_rate, ground(), time);
  }
  asked.gesture = gestures_.now();
  stages_.step(asked,
               {strengths_.shape(), strengths_.amount(), flight_, options_.root, options_.foot_lock,
                options_.tempo_everywhere},
               observer_, window_, time, clock);
  observer_.write(stages_.change(), out);
  tell(clock, Stage::write);
  started_ = true;
  next_.seconds = 0;
}

double Stylizer::rate() const noexcept { return stages_.rate(strengths_.shape().timing, flight_); }

template <class Self, class Visit>
void Stylizer::visit_state(Self& self, Visit&& visit) {
  visit(self.started_), visit(self.flight_);
  FlightWatch::visit_state(self.flights_, visit);
  Observer::visit_state(self.observer_, visit);
  EasedStrengths::visit_state(self.strengths_, visit);
  InputWindow::visit_state(self.window_, visit);
  StyleNetworks::visit_state(self.networks_, visit);
  ChangeStages::visit_state(self.stages_, visit);
  GesturePlayer::visit_state(self.gestures_, visit);
}

size_t Stylizer::state_size() const noexcept {
  return state_bytes([this](auto&& visit) { visit_state(*this, visit); });
}

void Stylizer::save(std::span<std::byte> out) const noexcept {
  assert(out.size() == state_size());
  write_state(out, [this](auto&& visit) { visit_state(*this, visit); });
}

bool Stylizer::restore(std::span<const std::byte> in) noexcept {
  if (in.size() != state_size() || !is_whole_state(in)) return false;
  read_state(in, [this](auto&& visit) { visit_state(*this, visit); });
  return true;
}

}  // namespace panache
