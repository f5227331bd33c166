#pragma once
// Finds arms and legs of a skeleton without meaningful names, by branching, symmetry, lengths and
// heights. Private to the folder.

#include <array>
#include <optional>
#include <span>
#include <string>

#include "rig/joint_name.h"
#include "rig/limb_shape.h"

namespace panache {

// names[joints]: only their sides are used. Nothing if no two pairs of limbs look like arms and
// legs of a body that stands in some of the poses.
std::optional<Limbs> find_limbs_by_shape(const JointTree& tree, std::span<const JointName> names);

// How upright the body is with these limbs: the cosine between legs and torso, 1 for an upright
// body, negative if arms and legs are exchanged. The maximum over the poses.
float uprightness(const JointTree& tree, const std::array<Limb, 2>& arms,
                  const std::array<Limb, 2>& legs);

}  // namespace panache
