#pragma once
// A whole clip with the changes of a source, at the tempo that it asks for: what restyle() does
// with a model's, and the laboratory with those of other systems.

#include <functional>
#include <memory>

#include "style/change_source.h"
#include "style/restyle.h"

namespace panache {

// Each time a new one, which has asked for nothing yet.
using MakeSource = std::function<std::unique_ptr<ChangeSource>()>;

// `loop`: the result becomes a loop, if the clip does not stay as it is, bit for bit; of one that
// is_loop() or that check_closable() lets pass. LoopMode is not looked at. `progress`: see
// restyle().
Restyled play_clip(const Clip& clip, const Rig& rig, const MakeSource& make_source, bool loop,
                   const RestyleOptions& options, const std::function<void(double)>& progress = {});

}  // namespace panache
