#pragma once
// A style's numbers and the body they change.

#include <span>

#include "base/quat.h"

#include "pose/features.h"
#include "style/model.h"
#include "style/style_delta.h"

namespace panache {

// The change that leads from the input to an absolute pose, as recipe smith2019 answers with one.
// `pose`: 130 numbers in layout rotations; `body`: the input in the body frame; `root`: its root
// numbers.
ChangeNumbers change_to_pose(std::span<const float> pose, const HumanPositions& body,
                             std::span<const float, kRootNumbers> root) noexcept;

// World rotation that the change puts on a joint, in the heading frame.
Quat joint_rotation(const ChangeNumbers& change, int joint) noexcept;
Quat joint_rotation(const StyleDelta& delta, int joint) noexcept;

// The canonical body (body frame, metres) with the change's rotations and hips height on it.
HumanPositions change_body(const HumanPositions& body, const ChangeNumbers& change) noexcept;

}  // namespace panache
