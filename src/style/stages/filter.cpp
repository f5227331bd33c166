#include "style/stages/filter.h"

#include <algorithm>
#include <cmath>

#include "style/stages/shape.h"

namespace panache {
namespace {

constexpr float kRateSeconds = 0.05f;  // Time constant of the tempo.
// A change may move joints as fast as they move themselves plus a little, so that a standing body
// is not frozen; m/s. Beyond, it is smoothed at most kSlowest times as long. A share of 0.2 halves
// the movement of styles on walks that the model does not know.
constexpr float kFreeShare = 1, kStillSpeed = 0.1f, kSlowest = 11;
constexpr float kSpeedSeconds = 0.1f;  // Over which speeds are averaged.
// This applies while the gate is closed by at least this much, on average over this time. While it
// is open, the motion is like the training data, and nothing is held back.
constexpr float kUnfamiliarGate = 0.005f, kGateSeconds = 3;
// Lever of a turning joint, about half a limb, and the time constant of the usual filter.
constexpr float kLever = 0.4f, kUsualSeconds = 0.04f;
constexpr float kFastest = 100;  // m/s; also substituted for NaN.
constexpr float kNear = 1e-7f, kNearRate = 1e-6f;

float finite(float number) { return std::isfinite(number) ? number : 0.0f; }
Vec3 finite(Vec3 v) { return {finite(v.x), finite(v.y), finite(v.z)}; }

}  // namespace

std::array<float, kRegions> OutputFilter::gains(const StyleDelta& delta, float gate,
                                                const HumanPositions& body,
                                                const StepTime& time) noexcept {
  std::array<float, kRegions> speed{}, change{}, joints{}, gain;
  for (int j = 0; j < kHumanJoints; ++j) {
    const auto region = static_cast<size_t>(region_of(j));
    speed[region] += length(body[j] - body_[j]);
    change[region] += length(finite(delta.rotations[j]) - delta_.rotations[j]);
    ++joints[region];
  }
  body_ = body;
  gate_ += time.gain(kGateSeconds) * (finite(gate) - gate_);
  gain.fill(time.gain(smoothing_seconds_));
  // The first step goes all the way, and nothing has moved yet.
  const auto seconds = static_cast<float>(time.input);
  if (time.first || !(seconds > 0)) return gain;
  const float unfamiliar = std::clamp((1 - gate_) / kUnfamiliarGate, 0.0f, 1.0f);
  const float follow = time.gain(kSpeedSeconds);
  for (size_t r = 0; r < kRegions; ++r) {
    const float own = speed[r] / (joints[r] * seconds);
    const float added = change[r] * kLever / (joints[r] * kUsualSeconds);
    speed_[r] += follow * (std::min(kFastest, own) - speed_[r]);
    added_speed_[r] += follow * (std::min(kFastest, added) - added_speed_[r]);
    if (unfamiliar == 0) continue;
    const float free = kFreeShare * (speed_[r] + kStillSpeed);
    const float slowness = std::clamp(added_speed_[r] / free, 1.0f, kSlowest);
    gain[r] = time.gain(smoothing_seconds_ * (1 + unfamiliar * (slowness - 1)));
  }
  return gain;
}

void OutputFilter::step(const StyleDelta& delta, float log_rate, float gate,
                        const HumanPositions& body, const StepTime& time) noexcept {
  const std::array<float, kRegions> gain = gains(delta, gate, body, time);
  const auto smooth = [&](float& value, float wanted, Region region = Region::legs) {
    approach(value, finite(wanted), gain[static_cast<size_t>(region)], kNear);
  };
  for (int j = 0; j < kHumanJoints; ++j) {
    const Region region = region_of(j);
    smooth(delta_.rotations[j].x, delta.rotations[j].x, region);
    smooth(delta_.rotations[j].y, delta.rotations[j].y, region);
    smooth(delta_.rotations[j].z, delta.rotations[j].z, region);
  }
  smooth(delta_.hips_height, delta.hips_height);
  smooth(delta_.velocity_left, delta.velocity_left);
  smooth(delta_.velocity_forward, delta.velocity_forward);
  smooth(delta_.turn_rate, delta.turn_rate);
  approach(log_rate_, bounded_log_rate(finite(log_rate)), time.gain(kRateSeconds), kNearRate);
}

}  // namespace panache
