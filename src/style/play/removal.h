#pragma once
// Takes a style off a motion: a first pass with the remover, a model trained on reversed pairs,
// makes it neutral; a second pass may put another style on.

#include <memory>
#include <string>
#include <string_view>

#include "style/restyle.h"

namespace panache {

// Whether a model takes its styles off instead of putting them on (see names.h).
bool is_remover(const Model& model);

// The remover's index of the style to take off; "" means kAnyStyle, for motion in an unknown style.
// Fails if `remover` puts styles on, or with the nearest names if the name is unknown.
Result<int> find_removal(const Model& remover, std::string_view style);

// What to take off.
struct Removal {
  std::shared_ptr<const Model> remover;
  int style = 0;  // Index in the remover.
};

// Takes the style off the clip, then calls restyle(). Shape, sides and tracks apply to the styles
// that are put on; times are seconds of the clip. With all strengths at 0 the result is the neutral
// motion.
Result<Restyled> restyle_without(const Clip& clip, const Rig& rig, const Removal& removal,
                                 const std::shared_ptr<const Model>& model,
                                 const std::vector<StrengthTrack>& tracks,
                                 const RestyleOptions& options = {},
                                 const std::function<void(double)>& progress = {});

}  // namespace panache
