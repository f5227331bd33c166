#pragma once
// Neutral takes of several tempos. A styled take is paired with the neutral take that it is most
// like, so a performer who walks slowly and fast, but never as usual, would teach how much faster
// every style is than the slow walk.

#include <vector>

#include "learn/pairing.h"
#include "learn/samples.h"
#include "learn/take.h"

namespace panache {

// Brings the tempos of samples and pairings to the mean tempo (geometric) of the neutral takes that
// the styled take may be paired with: those of its performer and action, or of all performers where
// its own has none. How much faster one take is than another is measured by pairing the two both
// ways. Root motion is left alone, because it counts by the input's time. `takes`: those that
// pairings and set are made of.
void level_neutral_tempos(const std::vector<Take>& takes, std::vector<Pairing>& pairings,
                          SampleSet& set);

}  // namespace panache
