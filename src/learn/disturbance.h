#pragma once
// Random disturbances of a window in training, which stand for other bodies, captures and files.

#include <array>
#include <span>
#include <vector>

#include "base/quat.h"
#include "base/random.h"
#include "learn/samples.h"
#include "recipes/training_settings.h"
#include "rig/humanoid.h"

namespace panache {

// One random draw of a disturbance, for all poses that share it.
struct Disturbed {
  float scale = 1, floor = 0, cos = 1, sin = 0, tempo = 1;
  std::vector<float> posture;  // Added to the joint positions. [63] metres
  // Differences of another person: the rotation of each joint, body frame, and the scale of all
  // movement about `centre` ([66], or empty for the same person).
  std::array<Quat, kHumanJoints> turns{};
  float amplitude = 1;
  std::vector<float> centre;
};

// `units`: for each pose feature in layout positions.
Disturbed draw_disturbance(const Disturbance& disturbance, const InputUnits& units, Random& random);

// Disturbs any number of poses in layout positions, in place. Does not apply the tempo: callers do
// when they cut the window.
void disturb(const Disturbed& draw, const Disturbance& disturbance, Random& random,
             std::span<float> poses);

}  // namespace panache
