#pragma once
// Plays a whole clip with the changes of a source, at the tempo it requests: restyle() uses a
// model as the source, the laboratory other systems.

#include <functional>
#include <memory>

#include "style/networks/change_source.h"
#include "style/restyle.h"

namespace panache {

// Returns a new, unused source each time.
using MakeSource = std::function<std::unique_ptr<ChangeSource>()>;

// `loop`: the result becomes a loop, unless it is identical to the clip; requires is_loop() or
// check_closable(). LoopMode is ignored. `progress`: see restyle().
Restyled play_clip(const Clip& clip, const Rig& rig, const MakeSource& make_source, bool loop,
                   const RestyleOptions& options, const std::function<void(double)>& progress = {});

// The part of play_clip() for loops: plays a clip repeatedly until the result repeats.
// The result begins at the input's first frame; its last pose equals its first, except for travel;
// see Restyled::loop.
Restyled play_loop(const Clip& clip, const Rig& rig, ChangeSource& source,
                   const RestyleOptions& options, const std::function<void(double)>& progress);

}  // namespace panache
