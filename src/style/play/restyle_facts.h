#pragma once
// Facts about a restyled clip.

#include "style/restyle.h"

namespace panache {

struct RestyleFacts {
  bool unchanged = false;  // The result is the clip, bit for bit.
  LoopFacts loop;
  // Shares, 0 to 1: the mean of Stylizer::gate(), frames in which something besides the feet held
  // the body, and frames in which hands kept what they touch.
  float known = 1, seated = 0, touching = 0;
  // The share of frames with a planted foot that stands in the input, 0 to 1, and the mean sliding
  // speed of such feet's toes in the result and in the input, m/s.
  float planted = 0, slide = 0, input_slide = 0;
};

// `clip`: the input of `result`, with the joints of `rig`.
RestyleFacts restyle_facts(const Clip& clip, const Rig& rig, const Restyled& result);

}  // namespace panache
