#pragma once
// Mirrors a pose's features, left for right.

#include <span>

#include "pose/features.h"

namespace panache {

// In place. numbers[pose_feature_count(layout)]
void mirror_pose(PoseLayout layout, std::span<float> numbers) noexcept;
// The same for any number of consecutive poses.
void mirror_poses(PoseLayout layout, std::span<float> numbers) noexcept;

}  // namespace panache
