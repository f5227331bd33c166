#pragma once
// Tells left from right by the body, where the names of joints contradict it. Private to the
// folder.

#include <string>
#include <vector>

#include "clip/clip.h"
#include "rig/mapping.h"

namespace panache {

// Exchanges left and right of arms, legs or both in `mapping` where toes, knees and path show that
// the body faces the other way, as in a mirrored armature or with names that exchange the sides, or
// where the arms are on the other side than the legs. Then adds a note to `notes`. Sides of joints
// in `known` stay.
void take_sides_of_body(const Clip& clip, const KnownJoints& known, Mapping& mapping,
                        std::vector<std::string>& notes);

}  // namespace panache
