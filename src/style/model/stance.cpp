#include "style/model/stance.h"

namespace panache {
namespace {

constexpr float kMinHeel = 0.17f;  // Radians; the next style to those on tiptoe has 0.15.

}  // namespace

Stance stance_of(const StyleDelta& mean) noexcept {
  Stance stance;
  float heel = 0;
  for (size_t f = 0; f < kFeet; ++f) {
    const Vec3 turn = mean.rotations[index(kAnkles[f])];
    heel += turn.x / kFeet;
    stance.turn[f] = turn.y;
  }
  if (heel > kMinHeel) stance.heel = heel;
  return stance;
}

}  // namespace panache
