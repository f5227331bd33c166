#pragma once
// How a character is restyled, whatever asks for the change.

#include <cstdint>

#include "base/result.h"
#include "pose/observer.h"
#include "style/shape.h"

namespace panache {

struct StylizerOptions {
  // A change of strength or shape takes about this long to arrive.
  float ease_seconds = 0.15f;
  // Time constant of the filter on the change, never on the input; see OutputFilter.
  float smoothing_seconds = 0.04f;
  bool foot_lock = true;
  // Hands keep what they touch. Not where a style is taken off: it may be what puts them there.
  bool hold_hands = true;
  bool root = true;  // Style the root motion, not only the pose.
  // The style's tempo also where the feet stand; otherwise such motion keeps its input's time.
  bool tempo_everywhere = false;
  Shape shape;  // At first, see Stylizer::set_shape().
  // Hips that are faster over the ground, m/s, have jumped, and the past is forgotten. Bodies on
  // vehicles need more; infinity: nothing is a jump.
  float max_speed = Observer::kMaxGroundSpeed;
  // Gestures of the styles in force, thrown in at random: so many per second, 0 to
  // GesturePlayer::kMaxRate. Characters with different seeds play them at different times.
  float gesture_rate = 0;
  uint32_t gesture_seed = 0;
};

// Fails with a message where an option is out of its range.
Result<void> check(const StylizerOptions& options);

}  // namespace panache
