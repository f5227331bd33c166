#include "walker/idle.h"

#include <cmath>
#include <numbers>

namespace panache {
namespace {

constexpr float kDegree = std::numbers::pi_v<float> / 180;

// Channels of the driven joints that idle; each joint has x (nods), y (turns), z (tilts).
constexpr int kHips = 3, kSpine = 6, kChest = 9, kNeck = 12, kLeftShoulder = 15,
              kRightShoulder = 24;

}  // namespace

void add_idle(double seconds, float standing, Channels& channels) noexcept {
  constexpr double turn = 2 * std::numbers::pi;
  const auto wave = [&](double hertz, double phase) {
    return static_cast<float>(std::sin(turn * std::fmod(hertz * seconds + phase, 1.0)));
  };
  // Fifteen breaths a minute lift ribs and shoulders; the head stays level.
  const float breath = wave(0.25, 0);
  channels[kChest] -= 0.7f * kDegree * breath;
  channels[kNeck] += 0.6f * kDegree * breath;
  channels[kLeftShoulder + 2] += 0.6f * kDegree * breath;
  channels[kRightShoulder + 2] -= 0.6f * kDegree * breath;
  // Frequencies without a common measure do not repeat within a clip.
  channels[kNeck + 1] += kDegree * (1.6f * wave(0.071, 0.2) + 1.1f * wave(0.173, 0.6));
  channels[kNeck] += kDegree * 0.8f * wave(0.113, 0.4);
  channels[kChest + 1] += kDegree * 0.7f * wave(0.093, 0.1);

  // Weight to one side: the hips follow it and tilt, the spine stays upright.
  const float side = standing * (0.7f * wave(0.061, 0.05) + 0.3f * wave(0.147, 0.3));
  channels[0] += 0.018f * side;
  channels[1] -= 0.002f * side * side;
  channels[2] += 0.004f * standing * wave(0.197, 0.7);
  channels[kHips + 2] += 1.6f * kDegree * side;
  channels[kSpine + 2] -= 1.8f * kDegree * side;
}

}  // namespace panache
