#pragma once
// Options for restyling a character, with any source of change.

#include <cstdint>
#include <vector>

#include "base/result.h"
#include "pose/observer.h"
#include "style/model/person.h"
#include "style/stages/shape.h"

namespace panache {

struct StylizerOptions {
  // A change of strength or shape takes about this long.
  float ease_seconds = 0.15f;
  // Time constant of the filter on the change, never on the input; see OutputFilter.
  float smoothing_seconds = 0.04f;
  bool foot_lock = true;
  bool root = true;  // Style the root motion, not only the pose.
  // Use the style's tempo even while the feet stand; otherwise such motion keeps the input's time.
  bool tempo_everywhere = false;
  Shape shape;  // Initially, see Stylizer::set_shape().
  // Initially, see Stylizer::set_side(): one per style, -1 to 1; empty: all 1.
  std::vector<float> sides;
  // Initially, see Stylizer::set_person().
  PersonNumbers person = {};
  // Faster hips over the ground, m/s, count as a cut, and the past is forgotten. Bodies on vehicles
  // need more; infinity: no cuts.
  float max_speed = Observer::kMaxGroundSpeed;
  // How often the active styles play their gestures: 1 as often as their takes do, 0 not at all; to
  // GesturePlayer::kMaxOften. Characters with different seeds play them at different times.
  float gesture_rate = 1;
  uint32_t gesture_seed = 0;
};

class Model;

// Fails with a message if an option is out of range, or if the sides do not suit the model's
// styles.
Result<void> check(const StylizerOptions& options, const Model& model);

}  // namespace panache
