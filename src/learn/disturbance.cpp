#include "learn/disturbance.h"

#include <cmath>

#include "pose/features.h"

namespace panache {

Disturbed draw_disturbance(const Disturbance& how, std::span<const float> deviation,
                           Random& random) {
  Disturbed draw;
  draw.scale = 1 + how.scale * random.normal();
  draw.floor = how.floor * random.normal();
  draw.tempo = std::exp(how.tempo * random.normal());
  const float angle = how.heading * random.normal();
  draw.cos = std::cos(angle);
  draw.sin = std::sin(angle);
  draw.posture.resize(3 * kHumanJoints);
  for (int i = 0; i < 3 * kHumanJoints; ++i) {
    draw.posture[i] = how.posture * deviation[i] * random.normal();
  }
  return draw;
}

void disturb(const Disturbed& draw, const Disturbance& how, Random& random,
             std::span<float> poses) {
  const size_t numbers = pose_feature_count(PoseLayout::positions);
  for (size_t at = 0; at < poses.size(); at += numbers) {
    float* pose = &poses[at];
    for (int j = 0; j < kHumanJoints; ++j) {
      float* p = pose + 3 * j;
      const float x = p[0] * draw.scale, z = p[2] * draw.scale;
      p[0] = draw.cos * x + draw.sin * z + draw.posture[3 * j] + how.jitter * random.normal();
      p[1] =
          p[1] * draw.scale + draw.floor + draw.posture[3 * j + 1] + how.jitter * random.normal();
      p[2] = draw.cos * z - draw.sin * x + draw.posture[3 * j + 2] + how.jitter * random.normal();
    }
    float* root = pose + root_offset(PoseLayout::positions);
    const float left = root[kVelocityLeft] * draw.scale;
    const float forward = root[kVelocityForward] * draw.scale;
    root[kVelocityLeft] = draw.cos * left + draw.sin * forward + how.velocity * random.normal();
    root[kVelocityForward] = draw.cos * forward - draw.sin * left + how.velocity * random.normal();
    root[kTurnRate] += how.turn_rate * random.normal();
  }
}

}  // namespace panache
