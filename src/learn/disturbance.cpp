#include "learn/disturbance.h"

#include <cmath>

#include "pose/features.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr int kPositions = 3 * kHumanJoints;

// The standard deviation of one joint's rotation about each axis.
float turn_of(const Disturbance& disturbance, int joint) {
  if (joint <= index(chest)) return disturbance.torso;
  if (joint <= index(head)) return disturbance.head;
  if (joint >= index(left_upper_leg)) return disturbance.legs;
  const bool collar = joint == index(left_shoulder) || joint == index(right_shoulder);
  return collar ? disturbance.torso : disturbance.arms;
}

void draw_person(const Disturbance& disturbance, const InputUnits& units, Random& random,
                 Disturbed& draw) {
  if (disturbance.torso == 0 && disturbance.head == 0 && disturbance.arms == 0 &&
      disturbance.legs == 0 && disturbance.amplitude == 0) {
    return;
  }
  for (int j = 0; j < kHumanJoints; ++j) {
    const float deviation = turn_of(disturbance, j);
    const float x = random.normal(), y = random.normal(), z = random.normal();
    draw.turns[j] = exp_rotation(Vec3{x, y, z} * deviation);
  }
  draw.amplitude = 1 + disturbance.amplitude * random.normal();
  draw.centre = units.mean;
}

// Changes one pose to how another person would hold it.
void apply_person(const Disturbed& draw, float* pose) {
  HumanPositions amplified, turned;
  for (int i = 0; i < kPositions; ++i) {
    pose[i] = draw.centre[i] + draw.amplitude * (pose[i] - draw.centre[i]);
  }
  for (int j = 0; j < kHumanJoints; ++j)
    amplified[j] = {pose[3 * j], pose[3 * j + 1], pose[3 * j + 2]};
  std::array<Quat, kHumanJoints> turns = draw.turns;
  turned[0] = amplified[0];
  for (int j = 1; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    turned[j] = turned[parent] + rotate(turns[parent], amplified[j] - amplified[parent]);
    turns[j] = turns[parent] * turns[j];
  }
  write_pose_features(PoseLayout::positions, turned, {pose, kPositions});
  float* root = pose + kPositions;
  root[kVelocityLeft] *= draw.amplitude;
  root[kVelocityForward] *= draw.amplitude;
}

}  // namespace

Disturbed draw_disturbance(const Disturbance& disturbance, const InputUnits& units,
                           Random& random) {
  Disturbed draw;
  draw.scale = 1 + disturbance.scale * random.normal();
  draw.floor = disturbance.floor * random.normal();
  draw.tempo = std::exp(disturbance.tempo * random.normal());
  const float angle = disturbance.heading * random.normal();
  draw.cos = std::cos(angle);
  draw.sin = std::sin(angle);
  draw.posture.resize(kPositions);
  for (int i = 0; i < kPositions; ++i) {
    draw.posture[i] = disturbance.posture * units.scale[i] * random.normal();
  }
  draw_person(disturbance, units, random, draw);
  return draw;
}

void disturb(const Disturbed& draw, const Disturbance& disturbance, Random& random,
             std::span<float> poses) {
  const size_t numbers = pose_feature_count(PoseLayout::positions);
  for (size_t at = 0; at < poses.size(); at += numbers) {
    float* pose = &poses[at];
    if (!draw.centre.empty()) apply_person(draw, pose);
    for (int j = 0; j < kHumanJoints; ++j) {
      float* p = pose + 3 * j;
      const float x = p[0] * draw.scale, z = p[2] * draw.scale;
      p[0] =
          draw.cos * x + draw.sin * z + draw.posture[3 * j] + disturbance.jitter * random.normal();
      p[1] = p[1] * draw.scale + draw.floor + draw.posture[3 * j + 1] +
             disturbance.jitter * random.normal();
      p[2] = draw.cos * z - draw.sin * x + draw.posture[3 * j + 2] +
             disturbance.jitter * random.normal();
    }
    float* root = pose + root_offset(PoseLayout::positions);
    const float left = root[kVelocityLeft] * draw.scale;
    const float forward = root[kVelocityForward] * draw.scale;
    root[kVelocityLeft] =
        draw.cos * left + draw.sin * forward + disturbance.velocity * random.normal();
    root[kVelocityForward] =
        draw.cos * forward - draw.sin * left + disturbance.velocity * random.normal();
    root[kTurnRate] += disturbance.turn_rate * random.normal();
  }
}

}  // namespace panache
