#pragma once
// How a rig was understood, in words and as JSON.

#include <string>

#include "messages.h"
#include "rig/rig.h"

namespace panache::cli {

// Unit, up axis and first frame, then a line for each human joint, then notes. `given` says which
// of them the user gave.
std::string describe_mapping(const Rig& rig, const RigOptions& given);
Json mapping_json(const Rig& rig);

}  // namespace panache::cli
