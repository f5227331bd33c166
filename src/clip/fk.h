#pragma once
// Forward kinematics: from transforms relative to the parent to transforms in the world.

#include "clip/clip.h"

namespace panache {

// world = the joints of `local` in the space of the roots' parent, file units. Both have the
// skeleton's joints, and may be the same arrays. Allocates nothing.
void world_pose(const Skeleton& skeleton, ConstPose local, Pose world) noexcept;

}  // namespace panache
