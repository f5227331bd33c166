#include "style/stages/filter.h"

#include <algorithm>
#include <cmath>

#include "style/rate.h"

namespace panache {
namespace {

constexpr float kRateSeconds = 0.05f;  // Time constant of the tempo.
constexpr float kNear = 1e-7f, kNearRate = 1e-6f;

float finite(float number) { return std::isfinite(number) ? number : 0.0f; }

}  // namespace

void OutputFilter::step(const StyleDelta& delta, float log_rate, const StepTime& time) noexcept {
  const float gain = time.gain(smoothing_seconds_);
  const auto smooth = [&](float& value, float wanted) {
    approach(value, finite(wanted), gain, kNear);
  };
  for (size_t j = 0; j < kHumanJoints; ++j) {
    smooth(delta_.rotations[j].x, delta.rotations[j].x);
    smooth(delta_.rotations[j].y, delta.rotations[j].y);
    smooth(delta_.rotations[j].z, delta.rotations[j].z);
  }
  smooth(delta_.hips_height, delta.hips_height);
  smooth(delta_.velocity_left, delta.velocity_left);
  smooth(delta_.velocity_forward, delta.velocity_forward);
  smooth(delta_.turn_rate, delta.turn_rate);
  approach(log_rate_, bounded_log_rate(finite(log_rate)), time.gain(kRateSeconds), kNearRate);
}

}  // namespace panache
