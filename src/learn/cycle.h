#pragma once
// Clips of one cycle, as in motion libraries: a stride that ends in the pose it starts with. Two of
// them may start anywhere in the cycle, so a neutral one is continued until the other fits.

#include <vector>

#include "learn/pairing.h"
#include "learn/take.h"

namespace panache {

// The number of frames (at kTakeRate) of one cycle, if the clip is one: its first pose repeats at
// its end, or would a frame later, wherever the body has moved meanwhile. 0 if it is not, or is
// longer than 2 seconds.
int cycle_frames(const Clip& clip, const Rig& rig);

// Pairs takes[styled] with takes[neutral], see pair_takes(). If the neutral take is one cycle (of
// `cycle` frames; 0 if not) and matches better when continued, it is replaced by several cycles,
// each starting where the one before ended.
std::vector<Pairing> pair_in_phase(std::vector<Take>& takes, int styled, int neutral, int cycle);

// Mean of Pairing::cost.
double mean_cost(const std::vector<Pairing>& pairings);

}  // namespace panache
