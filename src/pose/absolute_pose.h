#pragma once
// A whole pose of the canonical skeleton, by name; and the same as the numbers of layout rotations.

#include <array>
#include <span>

#include "base/quat.h"
#include "pose/features.h"

namespace panache {

struct AbsolutePose {
  // The hips' in the body frame, all others relative to the parent. As numbers: the first two
  // columns of the matrix.
  std::array<Quat, kHumanJoints> rotations;
  float hips_height = 0;                    // Metres.
  std::array<float, kRootFeatures> root{};  // See RootNumber.

  static constexpr int kSize = pose_feature_count(PoseLayout::rotations);  // Numbers when packed.
};

// The one order of the numbers: as the fields stand above.
void pack(const AbsolutePose& pose, std::span<float, AbsolutePose::kSize> out) noexcept;
// Columns need not be of length 1 or at right angles: networks answer with nearly such.
AbsolutePose unpack_pose(std::span<const float, AbsolutePose::kSize> numbers) noexcept;

// Rotations relative to the parents from those of a frame that all share.
std::array<Quat, kHumanJoints> to_local(const std::array<Quat, kHumanJoints>& frames) noexcept;
// Writes each as six numbers and returns where they end. out[6 * kHumanJoints]
float* write_rotations(const std::array<Quat, kHumanJoints>& rotations, float* out) noexcept;

}  // namespace panache
