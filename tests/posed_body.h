#pragma once
// A body in any pose, for tests of what joints may do.

#include <numbers>
#include <vector>

#include "clip/clip.h"
#include "rig/canonical_body.h"
#include "rig/humanoid.h"

namespace panache::test {

inline constexpr Vec3 kX = {1, 0, 0}, kY = {0, 1, 0}, kZ = {0, 0, 1};

struct Turn {
  HumanJoint joint;
  Vec3 axis;
  float degrees;
};

// A body that stands with hanging arms, but for these turns about the axes of the parent.
inline HumanPositions posed(const std::vector<Turn>& turns) {
  constexpr float kRadians = std::numbers::pi_v<float> / 180;
  const Skeleton skeleton = canonical_skeleton();
  std::vector<Quat> rotations(kHumanJoints);
  std::vector<Vec3> positions;
  for (const Joint& joint : skeleton.joints) positions.push_back(joint.offset);
  rotations[index(HumanJoint::left_upper_arm)] = axis_angle(kZ, -90 * kRadians);
  rotations[index(HumanJoint::right_upper_arm)] = axis_angle(kZ, 90 * kRadians);
  for (const auto& [joint, axis, degrees] : turns) {
    Quat& rotation = rotations[index(joint)];
    rotation = axis_angle(axis, degrees * kRadians) * rotation;
  }
  world_pose(skeleton, ConstPose{rotations, positions}, Pose{rotations, positions});
  HumanPositions body;
  for (int j = 0; j < kHumanJoints; ++j) body[j] = positions[j];
  return body;
}

// In the axes of the left upper arm, which lies along +x at rest: turns the forearm ahead. A right
// forearm is turned behind.
inline constexpr Vec3 kElbowAxis = {0, -1, 0};

}  // namespace panache::test
