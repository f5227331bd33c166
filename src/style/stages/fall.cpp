#include "style/stages/fall.h"

namespace panache {
namespace {

constexpr float kReturnSeconds = 0.12f;  // Time constant, on the ground.
constexpr float kNear = 1e-6f;           // Metres.

}  // namespace

void FreeFall::step(float flight, const StepTime& time, BodyChange& change) noexcept {
  const float wanted = change.translation.y;
  if (time.first) wanted_ = wanted, held_ = 0;
  held_ -= flight * (wanted - wanted_);
  approach(held_, 0, (1 - flight) * time.gain(kReturnSeconds), kNear);
  wanted_ = wanted;
  change.translation.y += held_;
}

}  // namespace panache
