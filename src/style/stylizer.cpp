#include "style/stylizer.h"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "style/pose_change.h"
#include "style/sound_pose.h"

namespace panache {
namespace {

constexpr float kMaxStrength = 4;
// A step over a longer gap, or a leap over the ground this fast, is a cut: the past says nothing.
constexpr double kMaxGap = 0.5;        // Seconds.
constexpr float kMaxGroundSpeed = 15;  // m/s; a sprinter reaches 12.
constexpr float kRateSeconds = 0.05f;  // Time constant of the tempo.
constexpr float kGateSeconds = 0.15f;  // Time constant of the gate.
constexpr float kMaxLogRate = 0.7f;    // Half to double tempo.
// A style may sway and turn within a step, but not leave the input's course: what it adds sideways
// and to the heading fades with this time constant.
constexpr float kCourseSeconds = 1.5f;
constexpr float kLiftSeconds = 0.1f;  // Time constant of what keeps the feet above the floor.
// Below this speed a character stands, or walks in place: the style may not carry it away.
constexpr float kStandingSpeed = 0.3f;  // m/s
// Well above this speed the way over the ground changes by the style's full share, below it by
// less.
constexpr float kSlowSpeed = 0.4f;  // m/s
constexpr float kMostShortened = 0.8f, kMostStretched = 1.5f;

// Share of the way to a target that a one-pole filter goes in `seconds`.
float filter_gain(float seconds, float time_constant) {
  return time_constant > 0 ? 1 - exponential(-seconds / time_constant) : 1.0f;
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
    : rig_(std::move(rig)),
      networks_(model),
      options_(options),
      rotations_(rig_.joint_count()),
      translations_(rig_.joint_count()),
      window_(size_t(kWindowPoses) * pose_numbers(model->layout())),
      strengths_(model->styles().size()),
      history_(model->layout()) {
  reset();
}

void Stylizer::reset() noexcept {
  started_ = false;
  time_ = 0;
  history_.clear();
  numbers_ = {};
  log_rate_ = 0;
  drift_ = {};
  sway_ = 0;
  turn_ = 0;
  lift_ = 0;
  foot_lock_.reset();
}

void Stylizer::ease_strengths(std::span<const float> strengths, float seconds) noexcept {
  assert(strengths.size() == strengths_.size());
  const float gain = started_ ? filter_gain(seconds, options_.ease_seconds) : 1.0f;
  float total = 0;
  for (size_t i = 0; i < strengths_.size(); ++i) {
    const float wanted =
        std::isfinite(strengths[i]) ? std::clamp(strengths[i], -kMaxStrength, kMaxStrength) : 0.0f;
    strengths_[i] += gain * (wanted - strengths_[i]);
    if (std::abs(wanted - strengths_[i]) < 1e-4f) strengths_[i] = wanted;
    total += std::abs(strengths_[i]);
  }
  amount_ = std::min(1.0f, 4 * total);
}

void Stylizer::take_answer(float seconds) noexcept {
  const auto root = std::span(window_).subspan(root_offset(model().layout())).first<kRootNumbers>();
  std::array<float, StyleDelta::kSize> wanted;
  pack(model().recipe().to_change(networks_.pose(), seen_, root), wanted);
  const float gain = started_ ? filter_gain(seconds, options_.smoothing_seconds) : 1.0f;
  for (size_t i = 0; i < wanted.size(); ++i) {
    if (!std::isfinite(wanted[i])) wanted[i] = 0;
    numbers_[i] += gain * (wanted[i] - numbers_[i]);
    if (std::abs(wanted[i] - numbers_[i]) < 1e-7f) numbers_[i] = wanted[i];
  }
  const float rate = std::isfinite(networks_.log_rate())
                         ? std::clamp(networks_.log_rate(), -kMaxLogRate, kMaxLogRate)
                         : 0.0f;
  log_rate_ += (started_ ? filter_gain(seconds, kRateSeconds) : 1.0f) * (rate - log_rate_);
  if (std::abs(rate - log_rate_) < 1e-6f) log_rate_ = rate;
}

float Stylizer::forward_speed() const noexcept {
  const size_t numbers = window_.size() / kWindowPoses;
  float sum = 0;
  for (int k = 0; k < kWindowPoses; ++k) sum += window_[(k + 1) * numbers - kRootNumbers + 1];
  return sum / kWindowPoses;
}

void Stylizer::move_root(double input_seconds) noexcept {
  if (!started_ || !options_.root) return;
  const float dt = static_cast<float>(input_seconds);
  // On unknown motion a style has no say in the way: its mean way is that of its walks.
  const float known = networks_.gate();
  const float moving = known * std::min(1.0f, history_.ground_speed() / kStandingSpeed);
  const float back = exponential(-dt / kCourseSeconds);
  const StyleDelta delta = unpack(numbers_);
  turn_ = turn_ * back + delta.turn_rate * moving * dt;
  sway_ = sway_ * back + delta.velocity_left * moving * dt;

  // Forward the style stretches or shortens the input's own way, by the share that its velocity is
  // of the input's: what comes back in the input comes back in the output, and what stands stays.
  // Each term is exactly zero without a style.
  const float speed = forward_speed();
  const float share =
      known * delta.velocity_forward * speed / (speed * speed + kSlowSpeed * kSlowSpeed);
  const Vec3 way = ground_.position - last_ground_.position;
  drift_ += rotate(rotation_y(turn_), way) - way;
  const float most = speed > 0 ? kMostStretched : 0.0f;  // Backwards, or the way would not close.
  drift_ += rotate(rotation_y(turn_), way) * std::clamp(share, -kMostShortened, most);
}

// A style trained on one body may put another's feet through the ground: lifts the body by as much
// as its lowest toe is deeper than both the floor and the input's own lowest toe. It comes and goes
// slowly, or the whole body would start at every step; what is left of the depth is up to the legs.
// `joints`: those of changed_joints().
void Stylizer::keep_above_floor(const HumanPositions& joints, float seconds) noexcept {
  const float depth = floor_depth(body_, joints, change_);
  const float gain = started_ ? filter_gain(seconds, kLiftSeconds) : 1.0f;
  lift_ += gain * (depth - lift_);
  change_.translation.y += amount_ * lift_;
}

void Stylizer::step(ConstPose in, std::span<const float> strengths, double input_seconds,
                    double output_seconds, Pose out) noexcept {
  const Times times = look(in, strengths, input_seconds, output_seconds);
  networks_.forward(window_, times.gate_share);
  change_pose(times, out);
}

Stylizer::Times Stylizer::look(ConstPose in, std::span<const float> strengths, double input_seconds,
                               double output_seconds) noexcept {
  if (!(input_seconds >= 0)) input_seconds = 0;
  if (!(output_seconds >= 0)) output_seconds = 0;
  if (input_seconds > kMaxGap || output_seconds > kMaxGap) reset();
  take_sound(in, {rotations_, translations_});
  rig_.read({rotations_, translations_}, body_);

  last_ground_ = ground_;
  const Vec3 hips = body_.positions[0];
  ground_ = {{hips.x, 0, hips.z}, unwrap_angle(body_.facing, started_ ? ground_.facing : 0)};
  if (started_ && length(ground_.position - last_ground_.position) >
                      kMaxGroundSpeed * static_cast<float>(std::max(input_seconds, 1e-3))) {
    reset();
  }
  time_ += input_seconds;
  to_body_frame(body_.positions, ground_, seen_);
  history_.push(time_, seen_, ground_);

  const float seconds = static_cast<float>(output_seconds);
  ease_strengths(strengths, seconds);
  networks_.set_strengths(strengths_);
  history_.window(window_);
  return {input_seconds, seconds, started_ ? filter_gain(seconds, kGateSeconds) : 1.0f};
}

void Stylizer::change_pose(const Times& times, Pose out) noexcept {
  take_answer(times.output);
  move_root(times.input);

  const StyleDelta delta = unpack(numbers_);
  for (int j = 0; j < kHumanJoints; ++j) change_.rotations[j] = joint_rotation(delta, j);
  change_.turn = turn_;
  const Vec3 side = rotate(rotation_y(ground_.facing + turn_), Vec3{sway_, 0, 0});
  change_.translation = drift_ + side + Vec3{0, delta.hips_height, 0};
  HumanPositions joints;
  changed_joints(body_, change_, joints);
  keep_above_floor(joints, times.output);
  if (options_.foot_lock) {
    foot_lock_.step(body_, joints, networks_.contact().first<kFeet>(), amount_, times.output,
                    change_);
  }
  rig_.write({rotations_, translations_}, body_, change_, out);
  started_ = true;
}

}  // namespace panache
