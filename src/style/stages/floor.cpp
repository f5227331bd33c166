#include "style/stages/floor.h"

namespace panache {
namespace {

constexpr float kLiftSeconds = 0.1f;  // Time constant.

}  // namespace

void FloorClearance::step(const BodyPose& body, const HumanPositions& joints, float amount,
                          const StepTime& time, BodyChange& change) noexcept {
  const float depth = floor_depth(body, joints, change);
  lift_ += time.gain(kLiftSeconds) * (depth - lift_);
  change.translation.y += amount * lift_;
}

}  // namespace panache
