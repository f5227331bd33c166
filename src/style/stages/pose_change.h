#pragma once
// Applies a style's change to a body.

#include <array>

#include "base/quat.h"
#include "pose/style_delta.h"
#include "rig/body_pose.h"
#include "style/model/predictor_network.h"

namespace panache {

// World rotation that the change applies to a joint, in the heading frame.
Quat joint_rotation(const StyleDelta& change, int joint) noexcept;
// The same for all joints.
std::array<Quat, kHumanJoints> joint_rotations(const StyleDelta& change) noexcept;

// The canonical body (body frame, metres) with the change's rotations and hips height.
HumanPositions change_body(const HumanPositions& body, const StyleDelta& change) noexcept;

// The change from the body `before` to the body `after`, both canonical.
BodyChange change_between(const PredictedPose& before, const PredictedPose& after) noexcept;

}  // namespace panache
