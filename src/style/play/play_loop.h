#pragma once
// The part of play_clip() for loops: plays a clip repeatedly until the result repeats.

#include "style/networks/change_source.h"
#include "style/restyle.h"

namespace panache {

// The result begins at the input's first frame; its last pose equals its first, except for travel;
// see Restyled::loop.
Restyled play_loop(const Clip& clip, const Rig& rig, ChangeSource& source,
                   const RestyleOptions& options, const std::function<void(double)>& progress);

}  // namespace panache
