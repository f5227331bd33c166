#pragma once
// Position and heading of a body on the ground, and the body frame there.

#include "rig/body_pose.h"

namespace panache {

// Position and heading on the ground plane.
struct RootPose {
  Vec3 position;     // Under the hips, y = 0; world, metres.
  float facing = 0;  // About +y, radians, unwrapped: it never jumps by a full turn.
};

// The root pose of `body`, with the facing nearest to `last_facing` (radians).
RootPose root_pose_of(const BodyPose& body, float last_facing) noexcept;

// The equivalent of `angle` (radians) nearest to `reference`.
float unwrap_angle(float angle, float reference) noexcept;

// From `a` (t = 0) to `b` (t = 1), linearly.
RootPose interpolate(const RootPose& a, const RootPose& b, float t) noexcept;

// `world` (Y up, metres) in the body frame: relative to the ground point under the hips, facing +z.
void to_body_frame(const HumanPositions& world, const RootPose& root,
                   HumanPositions& body) noexcept;
// The inverse.
HumanPositions to_world(const HumanPositions& body, const RootPose& root) noexcept;
Vec3 to_world(Vec3 point, const RootPose& root) noexcept;

}  // namespace panache
