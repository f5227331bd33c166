#pragma once
// Detects mappings that would tear a mesh or are not a person's. Private to the folder.

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

// Why a mapping is not a person's: its limbs are named as an animal's, all leave the body at one
// place, more pairs of them stand beside the body, or at rest and in the motion the hands are on
// the ground, or the legs bent without names that tell a person. `poses`: the rest pose, then poses
// of the motion. A map, of the hips or others, overrides this check.
std::optional<Error> find_other_creature(const Skeleton& skeleton,
                                         std::span<const JointPositions> poses,
                                         const Mapping& mapping, const KnownJoints& known);

}  // namespace panache
