#pragma once
// The body mesh, skinned to the joints of a rig's skeleton, for files.

#include "clip/skinned_body.h"
#include "rig/body_mesh.h"
#include "rig/rig.h"

namespace panache {

// The joint that moves each human joint's part of the body: itself, or the nearest ancestor that
// the rig has.
std::array<int, kHumanJoints> moving_joints(const Rig& rig);

// A body in the proportions of `rig`, scaled by Rig::unit(). `reference`: a pose without twists.
SkinnedBody make_rig_body(const Rig& rig, ConstPose reference);

}  // namespace panache
