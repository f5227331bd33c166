#include "pose/absolute_pose.h"

#include <algorithm>
#include <cmath>

namespace panache {
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
