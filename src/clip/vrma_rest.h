#pragma once
// The rest pose of a VRM animation as players take it. Private to the folder.

#include <vector>

#include "clip/clip.h"

namespace panache {

// Players give an avatar what each joint of the humanoid turns by against its rest pose in the
// file, whatever that pose is: to them it is the T-pose, facing +z. `rest` is the file's own, one
// frame, with the roles of its joints. Returns the offsets [joints] with which the same rest
// rotations stand in a T-pose: arms along x, legs down, toes ahead; a torso that leans, curves or
// faces elsewhere by more than 30 degrees is upright and faces +z.
std::vector<Vec3> t_pose_offsets(const Clip& rest);

// Gives `clip`, of the same joints, these offsets. Of the joints that have a role, or hang below
// one, only the hips keep their translations: players ignore all others.
void stand_in_t_pose(const std::vector<Vec3>& offsets, Clip& clip);

}  // namespace panache
