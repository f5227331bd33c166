#pragma once
// The humanoid of a rig as a skeleton of its own, for formats that hold nothing else.

#include "clip/clip.h"
#include "rig/rig.h"

namespace panache {

// One frame of a body that stands in T-pose on y = 0: metres, facing +z, arms along x, rest
// rotations of the identity. Its joints are the 21 human ones in their order, and three per finger
// that the rig has, all with their VRM names as names and roles; the hips translate. Torso and feet
// are those of the canonical body in the size of the rig's legs, arms and legs as long as the
// rig's in the unit of its file.
Clip t_pose_body(const Clip& clip, const Rig& rig);

}  // namespace panache
