#include "pose/contacts.h"

#include <algorithm>

#include "base/elementary.h"

namespace panache {
namespace {

// A planted toe of captured motion still creeps and shakes: takes of walking show under 0.3 m/s and
// 4 cm while it carries weight, and above 1 m/s soon after it left the ground.
constexpr float kMaxSpeed = 0.45f;   // m/s
constexpr float kMaxHeight = 0.06f;  // m, above the lowest tenth of that toe's own heights

// A toe as high as a planted one may be is near the floor, and one at twice that height is not.
constexpr float kInTheAir = 2 * kMaxHeight;

}  // namespace

float planted_near_floor(float probability, float toe_height) noexcept {
  const float t = std::clamp((kInTheAir - toe_height) / (kInTheAir - kMaxHeight), 0.0f, 1.0f);
  return probability * t;
}

std::vector<FootContacts> detect_contacts(const std::vector<HumanPositions>& world, double fps) {
  const int frames = static_cast<int>(world.size());
  std::vector<FootContacts> contacts(frames, FootContacts{});
  if (frames < 2) return contacts;
  for (int foot = 0; foot < kFeet; ++foot) {
    const int toe = index(kToes[foot]);
    std::vector<float> heights(frames);
    for (int f = 0; f < frames; ++f) heights[f] = world[f][toe].y;
    std::nth_element(heights.begin(), heights.begin() + frames / 10, heights.end());
    const float floor = heights[frames / 10];
    for (int f = 0; f < frames; ++f) {
      const int a = std::max(f - 1, 0), b = std::min(f + 1, frames - 1);
      const float speed = length(world[b][toe] - world[a][toe]) * static_cast<float>(fps) /
                          static_cast<float>(b - a);
      contacts[f][foot] = speed < kMaxSpeed && world[f][toe].y - floor < kMaxHeight;
    }
  }
  return contacts;
}

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
