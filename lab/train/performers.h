#pragma once
// Performers without a neutral take. Their styles are paired with the neutral takes of others, so
// the change from one to the other holds the style and what differs between the two persons. All
// styles of a performer share the second part. See docs/method.md, "Performers".

#include <vector>

#include "learn/samples.h"
#include "learn/take.h"

namespace panache {

// Takes off the targets of a set, whose recipe answers with packed StyleDeltas, what differs
// between a performer without a neutral take of an action and the others: the median over the
// performer's styles of what each changes, number by number, as far as persons differ more than
// styles do there (Wiener's estimate), and no more than persons differ. Both are measured on the
// performers who have neutral takes; nothing is taken off where these are fewer than three.
// `takes`: those that the set was made of.
void take_off_performers(const std::vector<Take>& takes, SampleSet& set);

}  // namespace panache
