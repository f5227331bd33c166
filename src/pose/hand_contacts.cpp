#include "pose/hand_contacts.h"

#include "base/easing.h"

namespace panache {
namespace {

// In arm lengths of about 52 cm: hands that hold one thing, and unrelated hands.
constexpr float kNear = 0.36f, kFar = 0.65f;

}  // namespace

float hands_nearness(float arm_lengths) noexcept {
  return smooth_step((kFar - arm_lengths) / (kFar - kNear));
}

void bring_together(Vec3 between, float amount, float of_right, Vec3& left, Vec3& right) noexcept {
  const Vec3 error = (between - (right - left)) * amount;
  left -= error * (1 - of_right);
  right += error * of_right;
}

}  // namespace panache
