#pragma once
// The walker's path: eases the wanted speed and turn, chooses between walk and run, and keeps the
// phase of the steps.

#include "walker/walker_model.h"

namespace panache {

inline constexpr float kMaxWalkerSpeed = 4.5f;  // m/s
// The sharpest turn at `speed`, rad/s: two rounds in six seconds on the spot, and less if the
// lateral acceleration would exceed a third of gravity.
float max_walker_turn(float speed) noexcept;

// The state of the steps at one moment.
struct Steps {
  // Per foot: how firmly it stands (0 to 1), its progress through the swing (0 to 1; 0 while it
  // stands) and through the stance (likewise).
  std::array<float, 2> stands{}, swing{}, stance{};
  float stance_seconds = 0;  // Duration of a stance.
};

class Drive {
 public:
  // Advances by `dt` seconds; `feet_settled`: the body can stand without another step.
  void tick(const WalkerModel& model, float wanted_speed, float wanted_turn, bool feet_settled,
            float dt) noexcept;

  // The gait's pose at this moment, before the feet are adjusted.
  void channels(const WalkerModel& model, Channels& out) const noexcept;
  Steps steps(const WalkerModel& model) const noexcept;

  bool is_stepping() const noexcept { return stepping_; }
  float amount() const noexcept { return amount_; }  // 0 standing to 1 at the slowest learnt walk.
  float stepping() const noexcept { return stepping_amount_; }  // Eased, 0 to 1.
  float phase() const noexcept { return static_cast<float>(phase_); }
  const Going& going() const noexcept { return going_; }
  float running() const noexcept { return running_; }  // 0 walking to 1 running.
  double x() const noexcept { return x_; }             // Metres.
  double z() const noexcept { return z_; }
  double heading() const noexcept { return heading_; }  // Radians, unwrapped.

 private:
  void ease(float wanted_speed, float wanted_turn, float dt) noexcept;
  void choose_gait(float dt) noexcept;
  void keep_stepping(const WalkerModel& model, bool wanted, bool feet_settled, float dt) noexcept;
  // Phases of landing and lift of the left foot, ascending.
  std::array<float, 2> contact(const WalkerModel& model) const noexcept;

  Going going_;
  float speed_change_ = 0;  // m/s^2; smoothed in `going_`.
  float turn_change_ = 0;   // rad/s^2
  double x_ = 0, z_ = 0, heading_ = 0;
  double phase_ = 0, seconds_ = 0;
  float frequency_ = 0;  // Cycles of two steps a second.
  bool wants_run_ = false, stepping_ = false;
  float running_ = 0, amount_ = 0, stepping_amount_ = 0;
};

}  // namespace panache
