#pragma once
// Clips of one cycle, as libraries have them: a stride that ends in the pose it starts with. Two of
// them may start anywhere in the cycle, so a neutral one is continued until the other fits.

#include <vector>

#include "learn/pairing.h"
#include "learn/take.h"

namespace panache {

// The frames of a take (see kTakeRate) that one cycle lasts, if the clip is one: its last pose is
// its first one again, or the one before that, wherever it has gone meanwhile. 0 if it is not, or
// lasts more than 2 seconds.
int cycle_frames(const Clip& clip, const Rig& rig);

// Pairs takes[styled] with takes[neutral], see pair_takes(). A neutral take of one cycle (of so
// many frames, or 0) that matches better when it is continued is replaced by several cycles of it,
// each where the one before ended.
std::vector<Pairing> pair_in_phase(std::vector<Take>& takes, int styled, int neutral, int cycle);

// Mean of Pairing::cost.
double mean_cost(const std::vector<Pairing>& pairings);

}  // namespace panache
