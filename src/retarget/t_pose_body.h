#pragma once
// The humanoid of a rig as a separate skeleton, for formats that hold only humanoids.

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

// One frame of a body in T-pose on y = 0: metres, facing +z, arms along x, identity rest rotations.
// Its joints are the 21 human joints in order, and three per finger of the rig, with VRM names as
// names and roles; the hips translate. Arms and legs have the rig's lengths in the unit of its
// file; torso and feet are the canonical body's, scaled to the rig's legs.
Clip t_pose_body(const Clip& clip, const Rig& rig);

}  // namespace panache
