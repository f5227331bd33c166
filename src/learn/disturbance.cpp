#include "learn/disturbance.h"

#include <cmath>

#include "pose/features.h"

namespace panache {
namespace {

using enum HumanJoint;

constexpr int kPositions = 3 * kHumanJoints;

// The standard deviation of one joint's rotation about each axis.
float turn_of(const Disturbance& how, int joint) {
  if (joint <= index(chest)) return how.torso;
  if (joint <= index(head)) return how.head;
  if (joint >= index(left_upper_leg)) return how.legs;
  const bool collar = joint == index(left_shoulder) || joint == index(right_shoulder);
  return collar ? how.torso : how.arms;
}

void draw_person(const Disturbance& how, const InputUnits& units, Random& random, Disturbed& draw) {
  if (how.torso == 0 && how.head == 0 && how.arms == 0 && how.legs == 0 && how.amplitude == 0) {
    return;
  }
  for (int j = 0; j < kHumanJoints; ++j) {
    const float deviation = turn_of(how, j);
    const float x = random.normal(), y = random.normal(), z = random.normal();
    draw.turns[j] = exp_rotation(Vec3{x, y, z} * deviation);
  }
  draw.amplitude = 1 + how.amplitude * random.normal();
  draw.centre = units.mean;
}

// Changes one pose to how another person would hold it.
void put_person(const Disturbed& draw, float* pose) {
  HumanPositions wide, turned;
  for (int i = 0; i < kPositions; ++i) {
    pose[i] = draw.centre[i] + draw.amplitude * (pose[i] - draw.centre[i]);
  }
  for (int j = 0; j < kHumanJoints; ++j) wide[j] = {pose[3 * j], pose[3 * j + 1], pose[3 * j + 2]};
  std::array<Quat, kHumanJoints> turns = draw.turns;
  turned[0] = wide[0];
  for (int j = 1; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    turned[j] = turned[parent] + rotate(turns[parent], wide[j] - wide[parent]);
    turns[j] = turns[parent] * turns[j];
  }
  write_pose_features(PoseLayout::positions, turned, {pose, kPositions});
  float* root = pose + kPositions;
  root[kVelocityLeft] *= draw.amplitude;
  root[kVelocityForward] *= draw.amplitude;
}

}  // namespace

Disturbed draw_disturbance(const Disturbance& how, const InputUnits& units, Random& random) {
  Disturbed draw;
  draw.scale = 1 + how.scale * random.normal();
  draw.floor = how.floor * random.normal();
  draw.tempo = std::exp(how.tempo * random.normal());
  const float angle = how.heading * random.normal();
  draw.cos = std::cos(angle);
  draw.sin = std::sin(angle);
  draw.posture.resize(kPositions);
  for (int i = 0; i < kPositions; ++i) {
    draw.posture[i] = how.posture * units.scale[i] * random.normal();
  }
  draw_person(how, units, random, draw);
  return draw;
}

void disturb(const Disturbed& draw, const Disturbance& how, Random& random,
             std::span<float> poses) {
  const size_t numbers = pose_feature_count(PoseLayout::positions);
  for (size_t at = 0; at < poses.size(); at += numbers) {
    float* pose = &poses[at];
    if (!draw.centre.empty()) put_person(draw, pose);
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
