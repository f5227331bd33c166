#pragma once
// Tells persons from other creatures that a mapping fits: insects, birds, frogs, dragons. Private
// to the folder.

#include <optional>
#include <span>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/joint_tree.h"
#include "rig/mapping.h"

namespace panache {

// Why a mapping is not a person's: its limbs are named as an animal's, all leave the body at one
// place, more pairs of them stand beside the body, or at rest and in the motion the hands are on
// the ground, or the legs bent without names that tell a person. `poses`: the rest pose, then poses
// of the motion. A map, of the hips or others, overrides this check.
std::optional<Error> find_other_creature(const Skeleton& skeleton,
                                         std::span<const JointPositions> poses,
                                         const Mapping& mapping, const KnownJoints& known);

}  // namespace panache
