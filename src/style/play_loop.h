#pragma once
// The part of play_clip() for loops: a clip is played round and round until the result repeats
// itself.

#include "style/change_source.h"
#include "style/restyle.h"

namespace panache {

// The result begins at the input's first frame and its last pose is its first, travel aside; see
// Restyled::loop.
Restyled play_loop(const Clip& clip, const Rig& rig, ChangeSource& source,
                   const RestyleOptions& options, const std::function<void(double)>& progress);

}  // namespace panache
