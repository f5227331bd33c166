#include "pose/mirror.h"

#include <algorithm>
#include <cassert>

namespace panache {
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

}  // namespace panache
