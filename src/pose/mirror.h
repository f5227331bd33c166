#pragma once
// Left for right of a pose's numbers.

#include <span>

#include "pose/features.h"

namespace panache {

// In place. numbers[pose_feature_count(layout)]
void mirror_pose(PoseLayout layout, std::span<float> numbers) noexcept;
// The same for any number of poses, one behind the other.
void mirror_poses(PoseLayout layout, std::span<float> numbers) noexcept;

}  // namespace panache
