#pragma once
// A loop restyled as a loop: it is played round and round until the result repeats itself.

#include "style/restyle.h"

namespace panache {

// As restyle(), of a clip that check_closable() lets pass. The result begins at the input's first
// frame and its last pose is its first, travel aside; see Restyled::loop.
Result<Restyled> restyle_loop(const Clip& clip, const Rig& rig,
                              const std::shared_ptr<const Model>& model,
                              const std::vector<StrengthTrack>& tracks,
                              const RestyleOptions& options,
                              const std::function<void(double)>& progress);

}  // namespace panache
