#pragma once
// A program's overrides for a rig.

#include "base/result.h"
#include "panache/panache.h"
#include "rig/rig.h"

namespace panache::api {

// Units, axes and human joints of the options, checked; not their poses.
Result<RigOptions> read_rig_options(const panache_skeleton_options& options, int32_t joint_count);

}  // namespace panache::api
