#pragma once
// The body mesh on the joints of a rig's own skeleton, for files.

#include "clip/skinned_body.h"
#include "rig/body_mesh.h"
#include "rig/rig.h"

namespace panache {

// The joint that moves what hangs on each human joint: itself, or the nearest joint above that the
// rig has.
std::array<int, kHumanJoints> moving_joints(const Rig& rig);

// A body to the measure of `rig`, metres as Rig::unit() means them. `reference` is a pose in which
// nothing is twisted.
SkinnedBody make_rig_body(const Rig& rig, ConstPose reference);

}  // namespace panache
