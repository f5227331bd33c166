#include "walker/drive.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "base/elementary.h"

namespace panache {
namespace {

constexpr float kTurn = 2 * std::numbers::pi_v<float>;
constexpr float kMaxSideways = 3.5f;            // m/s^2
constexpr float kMaxTurnOnTheSpot = kTurn / 3;  // rad/s

// Easing: the rate at which a difference closes, and the time that the change itself takes.
constexpr float kSpeedRate = 2.5f, kSpeedLag = 0.12f;
constexpr float kTurnRate = 4.0f, kTurnLag = 0.1f;
constexpr float kMaxTurnChange = 3.5f;  // rad/s^2
// The body takes about a step to lean into a change of speed.
constexpr float kLeanLag = 0.35f;

// People walk up to about 2 m/s and run above; the hysteresis keeps a steady speed from being a
// mixture.
constexpr float kRunAbove = 2.0f, kWalkBelow = 1.8f;
constexpr float kGaitChangeSeconds = 0.45f;

constexpr float kSlowestCadence = 0.6f;

float eased(float value, float target, float dt, float seconds) {
  return value + (target - value) * (1 - std::exp(-dt / seconds));
}

}  // namespace

float max_walker_turn(float speed) noexcept {
  return std::min(kMaxTurnOnTheSpot, kMaxSideways / std::max(speed, 0.1f));
}

void Drive::ease(float wanted_speed, float wanted_turn, float dt) noexcept {
  const float max_change = 1.3f + 0.35f * going_.speed;
  const float change =
      std::clamp((wanted_speed - going_.speed) * kSpeedRate, -max_change, max_change);
  speed_change_ = eased(speed_change_, change, dt, kSpeedLag);
  going_.speed += speed_change_ * dt;
  if (going_.speed < 0) going_.speed = speed_change_ = 0;
  going_.acceleration = eased(going_.acceleration, speed_change_, dt, kLeanLag);

  const float limit = max_walker_turn(going_.speed);
  const float turn = std::clamp(wanted_turn, -limit, limit);
  const float turn_change =
      std::clamp((turn - going_.turn) * kTurnRate, -kMaxTurnChange, kMaxTurnChange);
  turn_change_ = eased(turn_change_, turn_change, dt, kTurnLag);
  going_.turn += turn_change_ * dt;
}

void Drive::choose_gait(float dt) noexcept {
  if (going_.speed > kRunAbove) wants_run_ = true;
  if (going_.speed < kWalkBelow) wants_run_ = false;
  const float change = dt / kGaitChangeSeconds;
  running_ = std::clamp(running_ + (wants_run_ ? change : -change), 0.0f, 1.0f);
}

std::array<float, 2> Drive::contact(const WalkerModel& model) const noexcept {
  std::array<float, 2> out{};
  const float run = smooth_step(running_);
  const auto add = [&](const Gait& gait, float weight) {
    const float u = std::clamp(going_.speed, gait.slowest, gait.fastest) - gait.reference;
    out[0] += weight * (gait.lands[0] + gait.lands[1] * u);
    out[1] += weight * (gait.lifts[0] + gait.lifts[1] * u);
  };
  add(model.walk(), 1 - run);
  add(model.run(), run);
  return out;
}

void Drive::keep_stepping(const WalkerModel& model, bool wanted, bool feet_settled,
                          float dt) noexcept {
  const bool moves = going_.speed > 0.02f || std::abs(going_.turn) > 0.03f;
  if (!stepping_ && wanted) {
    // Starts when the foot on the side of the turn, else the right one, lifts. Standing looks the
    // same at every phase.
    const float lifts = contact(model)[1] - 0.05f * kTurn;
    phase_ = going_.turn + turn_change_ > 0 ? lifts : lifts + kTurn / 2;
    frequency_ = kSlowestCadence;
    stepping_ = true;
  } else if (stepping_ && !wanted && !moves && feet_settled) {
    stepping_ = false;
  }
  stepping_amount_ = eased(stepping_amount_, stepping_ ? 1.0f : 0.0f, dt, 0.15f);
  if (!stepping_) return;
  const float run = smooth_step(running_);
  float wanted_frequency =
      (1 - run) * cadence(model.walk(), going_.speed) + run * cadence(model.run(), going_.speed);
  // When turning on the spot, steps are frequent enough that a foot does not twist far under the
  // body, and when stopping, frequent enough to come to rest.
  wanted_frequency = std::max(wanted_frequency, kSlowestCadence + 0.35f * std::abs(going_.turn));
  if (!wanted) wanted_frequency = std::max(wanted_frequency, 0.75f);
  // Human strides vary in duration; these differ by about a percent.
  const auto t = static_cast<float>(std::fmod(seconds_, 1e4));
  wanted_frequency *= 1 + 0.007f * std::sin(1.9f * t) + 0.006f * std::sin(0.83f * t + 1);
  frequency_ = eased(frequency_, wanted_frequency, dt, 0.1f);
  phase_ = std::fmod(phase_ + kTurn * frequency_ * dt, double(kTurn));
}

void Drive::tick(const WalkerModel& model, float wanted_speed, float wanted_turn, bool feet_settled,
                 float dt) noexcept {
  seconds_ += dt;
  ease(wanted_speed, wanted_turn, dt);
  choose_gait(dt);
  keep_stepping(model, wanted_speed > 0.02f || std::abs(wanted_turn) > 0.03f, feet_settled, dt);
  // Below the lowest cadence, steps get shorter instead.
  const float rarer = cadence(model.walk(), going_.speed) / kSlowestCadence;
  amount_ = model.walk_stride(going_.speed).amount * std::min(1.0f, rarer);

  const double half = heading_ + double(going_.turn * dt) / 2;
  heading_ += going_.turn * dt;
  // The body faces ahead along the turning path.
  const double direction = half - going_.turn * model.walk().gaze_lead * amount_;
  x_ += std::sin(direction) * double(going_.speed * dt);
  z_ += std::cos(direction) * double(going_.speed * dt);
}

void Drive::channels(const WalkerModel& model, Channels& out) const noexcept {
  const float run = smooth_step(running_);
  out = model.stand();
  const auto add = [&](const Gait& gait, float speed, float weight) {
    if (weight <= 0) return;
    Going going = going_;
    going.speed = speed;
    Channels moving;
    evaluate(gait, phase(), going, moving);
    for (int c = 0; c < kChannels; ++c) out[c] += weight * (moving[c] - model.stand()[c]);
  };
  add(model.walk(), model.walk_stride(going_.speed).speed, amount_ * (1 - run));
  add(model.run(), model.run_stride(going_.speed).speed, amount_ * run);
}

Steps Drive::steps(const WalkerModel& model) const noexcept {
  // The part of the cycle in which the hold of a foot eases in, and out.
  constexpr float kRamp = 0.05f * kTurn;
  const std::array<float, 2> at = contact(model);
  const float stance = at[1] - at[0], swing = kTurn - stance;
  Steps out;
  out.stance_seconds = stance / kTurn / std::max(frequency_, 0.1f);
  for (int foot = 0; foot < 2; ++foot) {
    float since = phase() - at[0] - static_cast<float>(foot) * kTurn / 2;
    since -= kTurn * std::floor(since / kTurn);  // 0 as it lands, `stance` as it lifts.
    if (since < stance) {
      out.stance[foot] = since / stance;
      out.stands[foot] = smooth_step(std::min(since, stance - since) / kRamp);
    } else {
      out.swing[foot] = (since - stance) / swing;
    }
  }
  return out;
}

}  // namespace panache
