#include "pose/features.h"

#include <cassert>
#include <cmath>

#include "base/quat.h"
#include "pose/absolute_pose.h"
#include "rig/canonical_body.h"

namespace panache {

void write_pose_features(PoseLayout layout, const HumanPositions& body,
                         std::span<float> out) noexcept {
  assert(out.size() == size_t(root_offset(layout)));
  float* number = out.data();
  if (layout == PoseLayout::positions) {
    for (const Vec3& p : body) {
      *number++ = p.x;
      *number++ = p.y;
      *number++ = p.z;
    }
    return;
  }
  std::array<Quat, kHumanJoints> frames;
  canonical_frames(body, 0, frames);
  number = write_rotations(to_local(frames), number);
  *number = body[index(HumanJoint::hips)].y;
}

void write_root_features(const RootPose& before, const RootPose& now, double seconds,
                         std::span<float, kRootFeatures> out) noexcept {
  const float rate = static_cast<float>(1 / seconds);
  const Vec3 velocity = rotate(rotation_y(-now.facing), now.position - before.position) * rate;
  out[kVelocityLeft] = velocity.x;
  out[kVelocityForward] = velocity.z;
  out[kTurnRate] = (now.facing - before.facing) * rate;
}

HumanPositions read_positions(std::span<const float> pose) noexcept {
  HumanPositions body;
  for (size_t j = 0; j < body.size(); ++j)
    body[j] = {pose[3 * j], pose[3 * j + 1], pose[3 * j + 2]};
  return body;
}

RootPose move_root(const RootPose& before, std::span<const float, kRootFeatures> root,
                   double seconds) noexcept {
  const auto time = static_cast<float>(seconds);
  const float facing = before.facing + root[kTurnRate] * time;
  const Vec3 velocity{root[kVelocityLeft], 0, root[kVelocityForward]};
  return {before.position + rotate(rotation_y(facing), velocity * time), facing};
}

}  // namespace panache
