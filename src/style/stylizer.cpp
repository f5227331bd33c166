#include "style/stylizer.h"

#include <cassert>

#include "style/rate.h"
#include "style/state_bytes.h"

namespace panache {
namespace {

constexpr float kGateSeconds = 0.15f;  // Time constant of the gate.

void tell(StageClock* clock, Stage stage) noexcept {
  if (clock) clock->done(stage);
}

}  // namespace

Result<Stylizer> Stylizer::create(std::shared_ptr<const Model> model, Rig rig,
                                  const StylizerOptions& options) {
  for (const float seconds : {options.ease_seconds, options.smoothing_seconds}) {
    if (!(seconds >= 0 && seconds <= 10)) {
      return Error{"stylizer option of " + std::to_string(seconds) +
                   " seconds; expected 0 to 10 seconds"};
    }
  }
  return Stylizer(std::move(model), std::move(rig), options);
}

Stylizer::Stylizer(std::shared_ptr<const Model> model, Rig rig, const StylizerOptions& options)
    : options_(options),
      shape_(options.shape),
      observer_(std::move(rig)),
      strengths_(model->styles().size(), options.ease_seconds),
      window_(model->layout()),
      networks_(std::move(model)),
      filter_(options.smoothing_seconds) {}

void Stylizer::reset() noexcept {
  observer_.reset();
  forget();
}

void Stylizer::forget() noexcept {
  started_ = false;
  window_.reset();
  filter_.reset();
  root_.reset();
  shaping_.reset();
  anatomy_.reset();
  floor_.reset();
  fall_.reset();
  foot_lock_.reset();
  flights_.reset();
  flight_ = 0;
}

void Stylizer::step(ConstPose in, std::span<const float> strengths, double input_seconds,
                    double output_seconds, Pose out) noexcept {
  const StepTime time = take_in(in, strengths, input_seconds, output_seconds, nullptr);
  const StyleNetworks::Pass networks = pass(time);
  networks_.forward(networks.window, networks.gate_share);
  give_out(time, out, nullptr);
}

void Stylizer::step(ConstPose in, std::span<const float> strengths, double seconds, Pose out,
                    StageClock& clock) noexcept {
  const StepTime time = take_in(in, strengths, seconds, seconds, &clock);
  const StyleNetworks::Pass networks = pass(time);
  networks_.forward(networks.window, networks.gate_share);
  clock.done(Stage::networks);
  give_out(time, out, &clock);
}

StepTime Stylizer::take_in(ConstPose in, std::span<const float> strengths, double input_seconds,
                           double output_seconds, StageClock* clock) noexcept {
  if (!(input_seconds >= 0)) input_seconds = 0;
  if (!(output_seconds >= 0)) output_seconds = 0;
  if (output_seconds > Observer::kMaxGap) observer_.reset();
  if (!observer_.observe(in, input_seconds)) forget();
  tell(clock, Stage::observe);

  const StepTime time{input_seconds, static_cast<float>(output_seconds), !started_};
  strengths_.step(strengths, shape_, time);
  networks_.set_strengths(strengths_.now());
  tell(clock, Stage::strengths);
  window_.step(observer_.now(), time);
  flights_.push(window_.time(), observer_.now().world.positions);
  flight_ = seen_flight_ >= 0 ? seen_flight_ : flights_.amount(window_.time());
  seen_flight_ = -1;
  tell(clock, Stage::window);
  return time;
}

StyleNetworks::Pass Stylizer::pass(const StepTime& time) noexcept {
  return {&networks_, window_.window(), time.gain(kGateSeconds)};
}

void Stylizer::give_out(const StepTime& time, Pose out, StageClock* clock) noexcept {
  const Observation& now = observer_.now();
  const Shape& shape = strengths_.shape();
  const float amount = strengths_.amount();
  const StyleDelta delta =
      model().recipe().to_change(networks_.pose(), now.body_frame, window_.root());
  filter_.step(delta, networks_.log_rate(), time);
  tell(clock, Stage::filter);
  if (options_.root) root_.step(filter_.delta(), networks_.gate(), observer_, window_, time);
  tell(clock, Stage::root);
  shaping_.step(shape, filter_.delta(), root_.offset(now.root), time, change_);
  tell(clock, Stage::shape);
  anatomy_.step(now.world, rig(), time, change_);
  tell(clock, Stage::anatomy);
  HumanPositions joints;
  changed_joints(now.world, change_, joints);
  keep_balance(now.world, joints, change_);
  tell(clock, Stage::balance);
  floor_.step(now.world, joints, amount, time, change_);
  tell(clock, Stage::floor);
  fall_.step(flight_, time, change_);
  tell(clock, Stage::fall);
  for (size_t f = 0; f < kFeet; ++f) {
    const float height = now.world.positions[index(kToes[f])].y;
    contacts_[f] = planted_near_floor(networks_.contact()[f], height);
  }
  if (options_.foot_lock) {
    foot_lock_.step(now.world, joints, contacts_, amount * shape.foot_lock, time.output, change_);
  }
  tell(clock, Stage::feet);
  observer_.write(change_, out);
  tell(clock, Stage::write);
  started_ = true;
}

double Stylizer::rate() const noexcept {
  const float log_rate = bounded_log_rate(strengths_.shape().timing * filter_.log_rate());
  return static_cast<double>(exponential(log_rate * (1 - flight_)));
}

template <class Self, class Visit>
void Stylizer::visit_state(Self& self, Visit&& visit) {
  visit(self.started_), visit(self.contacts_), visit(self.change_), visit(self.flight_);
  visit(self.seen_flight_);
  FlightWatch::visit_state(self.flights_, visit);
  Observer::visit_state(self.observer_, visit);
  EasedStrengths::visit_state(self.strengths_, visit);
  InputWindow::visit_state(self.window_, visit);
  StyleNetworks::visit_state(self.networks_, visit);
  OutputFilter::visit_state(self.filter_, visit);
  RootMotion::visit_state(self.root_, visit);
  Shaping::visit_state(self.shaping_, visit);
  Anatomy::visit_state(self.anatomy_, visit);
  FloorClearance::visit_state(self.floor_, visit);
  FreeFall::visit_state(self.fall_, visit);
  FootLock::visit_state(self.foot_lock_, visit);
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
