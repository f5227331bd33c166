#pragma once
// What other bodies, captures and files do to a window: drawn at random in training.

#include <span>
#include <vector>

#include "base/random.h"
#include "recipes/training_settings.h"

namespace panache {

// The draw of one disturbance, for all poses that share it.
struct Disturbed {
  float scale = 1, floor = 0, cos = 1, sin = 0, tempo = 1;
  std::vector<float> posture;  // Added to the joint positions. [63] metres
};

// `deviation`: of each pose number in layout positions. [66]
Disturbed draw_disturbance(const Disturbance& how, std::span<const float> deviation,
                           Random& random);

// Disturbs poses in place, any number of them in layout positions. The tempo is for whoever cuts
// the window.
void disturb(const Disturbed& draw, const Disturbance& how, Random& random, std::span<float> poses);

}  // namespace panache
