#include "pose/root_pose.h"

#include <cmath>
#include <numbers>

#include "base/quat.h"

namespace panache {

RootPose root_pose_of(const BodyPose& body, float last_facing) noexcept {
  const Vec3 hips = body.positions[index(HumanJoint::hips)];
  return {{hips.x, 0, hips.z}, unwrap_angle(body.facing, last_facing)};
}

float unwrap_angle(float angle, float reference) noexcept {
  constexpr float turn = 2 * std::numbers::pi_v<float>;
  return angle - turn * std::round((angle - reference) / turn);
}

RootPose interpolate(const RootPose& a, const RootPose& b, float t) noexcept {
  return {lerp(a.position, b.position, t), a.facing * (1 - t) + b.facing * t};
}

void to_body_frame(const HumanPositions& world, const RootPose& root,
                   HumanPositions& body) noexcept {
  const Quat to_heading = rotation_y(-root.facing);
  for (int j = 0; j < kHumanJoints; ++j) body[j] = rotate(to_heading, world[j] - root.position);
}

HumanPositions to_world(const HumanPositions& body, const RootPose& root) noexcept {
  HumanPositions world;
  const Quat heading = rotation_y(root.facing);
  for (int j = 0; j < kHumanJoints; ++j) world[j] = root.position + rotate(heading, body[j]);
  return world;
}

Vec3 to_world(Vec3 point, const RootPose& root) noexcept {
  return root.position + rotate(rotation_y(root.facing), point);
}

}  // namespace panache
