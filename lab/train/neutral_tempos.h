#pragma once
// Neutral takes of several tempos. A styled take is paired with the most similar neutral take. A
// performer who walks slowly and fast, but never at the usual tempo, would therefore teach every
// style relative to the slow walk.

#include <vector>

#include "learn/pairing.h"
#include "learn/samples.h"
#include "learn/take.h"

namespace panache {

// Makes the tempos of samples and pairings relative to the geometric mean tempo of the neutral
// takes that the styled take may be paired with: those of its performer and action, or of all
// performers if its own has none. The relative tempo of two takes is measured by pairing them both
// ways. Root motion stays as it is, because it counts by the input's time. `takes`: the ones that
// pairings and set are made from.
void level_neutral_tempos(const std::vector<Take>& takes, std::vector<Pairing>& pairings,
                          SampleSet& set);

}  // namespace panache
