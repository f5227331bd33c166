#pragma once
// Performers without a neutral take. Their styles are paired with other performers' neutral takes,
// so each change contains both the style and the difference between two persons. The second part is
// common to all styles of a performer. See docs/method.md, "Performers".

#include <vector>

#include "learn/samples.h"
#include "learn/take.h"

namespace panache {

// Subtracts from the targets (packed StyleDeltas) the difference between a performer without a
// neutral take of an action and the others: per output, the median over the performer's styles,
// shrunk by how much persons vary compared with styles (Wiener's estimate), and at most as large as
// persons differ. Both variances are measured on performers with neutral takes; with fewer than
// three of these, nothing is subtracted. `takes`: the ones that the set was made from.
void take_off_performers(const std::vector<Take>& takes, SampleSet& set);

}  // namespace panache
