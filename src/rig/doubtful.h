#pragma once
// Detects mappings that would tear a mesh or are not human. Private to the folder.

#include <optional>
#include <span>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/joint_tree.h"
#include "rig/mapping.h"

namespace panache {

// Why a mapping cannot be trusted: its torso consists of control joints and its limbs of deforming
// joints, which are connected only in the program that made the file; its hips do not move all of
// the skin that the arms belong to, or no skin at all while another skeleton of the file does; or
// its arms are not below the spine. Nothing if the mapping is plausible. `known` hips override this
// check.
std::optional<Error> find_doubt(const Skeleton& skeleton, const Mapping& mapping,
                                const KnownJoints& known);

// Why a mapping is an animal's: arms and legs are parallel under a level torso in the first of
// `poses`, the rest pose, and in nearly all others, which are frames of the motion. A crawling
// person still has an upright rest pose. `known` hips override this check.
std::optional<Error> find_animal(const Skeleton& skeleton, std::span<const JointPositions> poses,
                                 const Mapping& mapping, const KnownJoints& known);

}  // namespace panache
