#pragma once
// A style taken off a motion: a first pass with a model that was trained on reversed pairs, the
// remover, makes it neutral; a second one may put another style on.

#include <memory>
#include <string>
#include <string_view>

#include "style/restyle.h"

namespace panache {

// Whether a model takes styles off (see names.h). Its styles are those that it takes off.
bool is_remover(const Model& model);

// The index in the remover of the style to take off; "" is kAnyStyle, for motion in a style that it
// does not know. Fails if `remover` puts styles on; an unknown name is answered with the nearest.
Result<int> find_removal(const Model& remover, std::string_view style);

// What to take off.
struct Removal {
  std::shared_ptr<const Model> remover;
  int style = 0;  // Of the remover.
};

// restyle() of the clip without the style. Shape and tracks are those of the styles that are put
// on; times count in seconds of the clip. With all strengths at 0 the result is the neutral motion.
Result<Restyled> restyle_without(const Clip& clip, const Rig& rig, const Removal& removal,
                                 const std::shared_ptr<const Model>& model,
                                 const std::vector<StrengthTrack>& tracks,
                                 const RestyleOptions& options = {},
                                 const std::function<void(double)>& progress = {});

}  // namespace panache
