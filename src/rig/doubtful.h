#pragma once
// Mappings that would tear a mesh. Private to the folder.

#include <optional>

#include "base/result.h"
#include "clip/clip.h"
#include "rig/mapping.h"

namespace panache {

// Why a mapping is not to be trusted: its torso is among the controls of a rig and its limbs are
// among the joints that deform, which the controls move in the program that made the file and not
// in the file itself; its hips do not move all of the skin that the arms are part of, or move no
// skin where another skeleton of the file does; or its arms hang beside the spine instead of on it.
// Nothing where all is well. What is `known` of the hips is believed.
std::optional<Error> find_doubt(const Skeleton& skeleton, const Mapping& mapping,
                                const KnownJoints& known);

}  // namespace panache
