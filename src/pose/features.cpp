#include "pose/features.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/quat.h"
#include "rig/canonical_body.h"

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

namespace {

constexpr int kPositionNumbers = 3, kRotationNumbers = 6;  // Of a joint.

// The first two columns of a rotation's matrix R become those of M R M with M = diag(-1, 1, 1).
void mirror_columns(float* c) {
  c[1] = -c[1];
  c[2] = -c[2];
  c[3] = -c[3];
}

void swap_sides(float* joints, int per_joint) {
  for (int j = 0; j < kHumanJoints; ++j) {
    if (kHumanMirror[j] > j) {
      std::swap_ranges(joints + j * per_joint, joints + (j + 1) * per_joint,
                       joints + kHumanMirror[j] * per_joint);
    }
  }
}

}  // namespace

void mirror_pose(PoseLayout layout, std::span<float> numbers) noexcept {
  assert(numbers.size() == size_t(pose_feature_count(layout)));
  float* pose = numbers.data();
  if (layout == PoseLayout::positions) {
    swap_sides(pose, kPositionNumbers);
    for (int j = 0; j < kHumanJoints; ++j) {
      float& x = pose[kPositionNumbers * j];
      x = -x;
    }
  } else {
    swap_sides(pose, kRotationNumbers);
    for (int j = 0; j < kHumanJoints; ++j) mirror_columns(pose + kRotationNumbers * j);
  }
  float* root = pose + root_offset(layout);
  root[kVelocityLeft] = -root[kVelocityLeft];
  root[kTurnRate] = -root[kTurnRate];
}

void mirror_poses(PoseLayout layout, std::span<float> numbers) noexcept {
  const size_t count = pose_feature_count(layout);
  for (size_t at = 0; at < numbers.size(); at += count) {
    mirror_pose(layout, numbers.subspan(at, count));
  }
}

namespace {

// Orthonormalises two columns (Gram-Schmidt).
Quat read_rotation(const float* n) {
  const Vec3 x = normalized(Vec3{n[0], n[1], n[2]}, Vec3{1, 0, 0});
  const Vec3 raw{n[3], n[4], n[5]};
  const Vec3 other = std::abs(x.y) < 0.9f ? Vec3{0, 1, 0} : Vec3{0, 0, 1};
  const Vec3 y = normalized(raw - x * dot(raw, x), normalized(other - x * dot(other, x)));
  return from_axes(x, y, cross(x, y));
}

}  // namespace

std::array<Quat, kHumanJoints> to_local(const std::array<Quat, kHumanJoints>& frames) noexcept {
  std::array<Quat, kHumanJoints> local;
  for (int j = 0; j < kHumanJoints; ++j) {
    const int parent = kHumanParent[j];
    local[j] = parent < 0 ? frames[j] : conjugate(frames[parent]) * frames[j];
  }
  return local;
}

float* write_rotations(const std::array<Quat, kHumanJoints>& rotations, float* out) noexcept {
  for (const Quat& rotation : rotations) {
    const Vec3 x = rotate(rotation, Vec3{1, 0, 0}), y = rotate(rotation, Vec3{0, 1, 0});
    for (const float v : {x.x, x.y, x.z, y.x, y.y, y.z}) *out++ = v;
  }
  return out;
}

void pack(const AbsolutePose& pose, std::span<float, AbsolutePose::kSize> out) noexcept {
  float* number = write_rotations(pose.rotations, out.data());
  *number++ = pose.hips_height;
  std::copy(pose.root.begin(), pose.root.end(), number);
}

AbsolutePose unpack_pose(std::span<const float, AbsolutePose::kSize> numbers) noexcept {
  AbsolutePose pose;
  const float* number = numbers.data();
  for (Quat& rotation : pose.rotations) {
    rotation = read_rotation(number);
    number += 6;
  }
  pose.hips_height = *number++;
  std::copy_n(number, pose.root.size(), pose.root.begin());
  return pose;
}

}  // namespace panache
