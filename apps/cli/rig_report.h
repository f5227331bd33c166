#pragma once
// How a rig was mapped, in text and as JSON.

#include <string>

#include "messages.h"
#include "rig/rig.h"

namespace panache::cli {

// Unit, up axis and first frame, then a line per human joint, then notes. `given` tells which of
// them the user set.
std::string describe_mapping(const Rig& rig, const RigOptions& given);
Json mapping_json(const Rig& rig);

}  // namespace panache::cli
