#pragma once
// Facts about a restyled clip.

#include "style/restyle.h"

namespace panache {

struct RestyleFacts {
  bool unchanged = false;  // The result is the clip, bit for bit.
  LoopFacts loop;
  // Shares of the motion, 0 to 1: what the styles made of this very motion (the mean of
  // Stylizer::gate()), and frames in which something besides its feet held the body, and in which
  // hands kept what they touch.
  float known = 1, seated = 0, touching = 0;
  // The share of frames with a planted foot that stands in the input, 0 to 1, and how fast the toes
  // of such feet slide, in the mean: in the result and in the input, m/s.
  float planted = 0, slide = 0, input_slide = 0;
};

// `clip`: what `result` was made of, with joints of `rig`.
RestyleFacts restyle_facts(const Clip& clip, const Rig& rig, const Restyled& result);

}  // namespace panache
