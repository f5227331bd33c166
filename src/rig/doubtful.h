#pragma once
// Mappings that would tear a mesh or that are no person's. Private to the folder.

#include <optional>
#include <span>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/joint_tree.h"
#include "rig/mapping.h"

namespace panache {

// Why a mapping is not to be trusted: its torso is among the controls of a rig and its limbs are
// among the joints that deform, which the controls move in the program that made the file and not
// in the file itself; its hips do not move all of the skin that the arms are part of, or move no
// skin where another skeleton of the file does; or its arms hang beside the spine instead of on it.
// Nothing where all is well. `known` hips override this check.
std::optional<Error> find_doubt(const Skeleton& skeleton, const Mapping& mapping,
                                const KnownJoints& known);

// Why a mapping is an animal's: its arms and legs stand side by side under a level trunk in the
// first of `poses`, which is the skeleton at rest, and in nearly all others, which are of its
// motion. A person who crawls stands upright at rest. `known` hips override this check.
std::optional<Error> find_animal(const Skeleton& skeleton, std::span<const JointPositions> poses,
                                 const Mapping& mapping, const KnownJoints& known);

}  // namespace panache
