#pragma once
// A whole pose of the canonical skeleton as named fields, and packed in PoseLayout::rotations.

#include <array>
#include <span>

#include "base/quat.h"
#include "pose/features.h"

namespace panache {

struct AbsolutePose {
  // The hips' in the body frame, all others relative to the parent. Packed as the first two columns
  // of the matrix.
  std::array<Quat, kHumanJoints> rotations;
  float hips_height = 0;                    // Metres.
  std::array<float, kRootFeatures> root{};  // See RootNumber.

  static constexpr int kSize = pose_feature_count(PoseLayout::rotations);  // Numbers when packed.
};

// Packs the fields in the order above.
void pack(const AbsolutePose& pose, std::span<float, AbsolutePose::kSize> out) noexcept;
// Columns need not be orthonormal: outputs of networks are only nearly so.
AbsolutePose unpack_pose(std::span<const float, AbsolutePose::kSize> numbers) noexcept;

// Converts rotations from a common frame to the parents' frames.
std::array<Quat, kHumanJoints> to_local(const std::array<Quat, kHumanJoints>& frames) noexcept;
// Writes six numbers per rotation and returns the end. out[6 * kHumanJoints]
float* write_rotations(const std::array<Quat, kHumanJoints>& rotations, float* out) noexcept;

}  // namespace panache
