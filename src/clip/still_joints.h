#pragma once
// Which joints an animation leaves alone. Private to the folder.

#include "clip/clip.h"

namespace panache {

// Sets `still` of each joint that rests in all frames of `clip` but for rounding. Its skeleton says
// where joints rest.
void mark_still_joints(Clip& clip);

}  // namespace panache
