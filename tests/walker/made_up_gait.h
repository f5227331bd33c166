#pragma once
// A walker of our own invention, for tests that need a model and no particular one.

#include <cmath>
#include <utility>

#include "walker/walker_model.h"

namespace panache::test {

// Legs that swing like pendulums, one harmonic, twice as far when running.
inline Gait made_up_gait(float reference, float swing) {
  Gait gait;
  gait.reference = reference;
  gait.slowest = reference * 0.6f;
  gait.fastest = reference * 1.4f;
  gait.cadence = 0.9f;
  gait.exponent = 0.3f;
  gait.lands = {0.1f, 0.1f};
  gait.lifts = {3.3f, -0.2f};
  gait.gaze_lead = 0.1f;
  gait.coefficients.assign(size_t(kChannels) * kWaves * kTerms, 0.0f);
  const auto at = [&](int channel, int wave, int term) -> float& {
    return gait.coefficients[(size_t(channel) * kWaves + wave) * kTerms + term];
  };
  at(1, 0, 0) = 0.86f;  // Height of the hips.
  const auto channel_of = [](HumanJoint joint) {
    for (size_t i = 0; i < kDriven.size(); ++i) {
      if (kDriven[i] == joint) return 3 + 3 * static_cast<int>(i);
    }
    return -1;
  };
  for (const auto& [joint, side] : {std::pair{HumanJoint::left_upper_leg, -1.0f},
                                    std::pair{HumanJoint::right_upper_leg, 1.0f}}) {
    at(channel_of(joint), 1, 0) = side * swing;
    at(channel_of(joint), 1, 1) = side * 0.1f;
  }
  for (const HumanJoint knee : {HumanJoint::left_lower_leg, HumanJoint::right_lower_leg}) {
    at(channel_of(knee), 0, 0) = 0.3f;
  }
  return gait;
}

inline WalkerModel made_up_walker() {
  Channels stand{};
  stand[1] = 0.88f;
  return WalkerModel(made_up_gait(1.1f, 0.4f), made_up_gait(2.8f, 0.7f), stand,
                     {{"data", "none"}, {"licence", "none"}});
}

}  // namespace panache::test
