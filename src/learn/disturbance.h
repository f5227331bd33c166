#pragma once
// Disturbances of a window by other bodies, captures and files: drawn at random in training.

#include <array>
#include <span>
#include <vector>

#include "base/quat.h"
#include "base/random.h"
#include "learn/samples.h"
#include "recipes/training_settings.h"
#include "rig/humanoid.h"

namespace panache {

// The draw of one disturbance, for all poses that share it.
struct Disturbed {
  float scale = 1, floor = 0, cos = 1, sin = 0, tempo = 1;
  std::vector<float> posture;  // Added to the joint positions. [63] metres
  // Of another person: how each joint is turned, body frame, and how wide everything moves about
  // `centre` ([66], or empty for the same person).
  std::array<Quat, kHumanJoints> turns{};
  float amplitude = 1;
  std::vector<float> centre;
};

// `units`: of each pose number in layout positions.
Disturbed draw_disturbance(const Disturbance& how, const InputUnits& units, Random& random);

// Disturbs any number of poses in layout positions, in place. The tempo is for callers that cut the
// window.
void disturb(const Disturbed& draw, const Disturbance& how, Random& random, std::span<float> poses);

}  // namespace panache
