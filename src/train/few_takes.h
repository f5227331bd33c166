#pragma once
// Where an action was taken once, its neutral and its styled take differ in more than the style. In
// the only neutral walk backwards of Bandai's first set the forearms are raised, in those of all
// styles they hang: pairs of them would teach each style to drop a boxer's guard. Of its waves some
// are at the chest and others high above the head. See docs/method.md, "Takes that differ in more
// than the style".

#include <vector>

#include "learn/samples.h"
#include "learn/take.h"

namespace panache {

// Corrects the targets of a set whose recipe answers with packed StyleDeltas.
// 1. What five styles or more change alike in one action, apart from what each of them changes
//    anyway, is how its one or two neutral takes were acted. It is taken off.
// 2. An arm whose hand is then much farther than usual from where the style puts it in other
//    actions gets the style's mean arm, if the style has one or two takes of the action.
// `takes`: those that the set was made of. Returns how many arms were replaced.
int correct_few_takes(const std::vector<Take>& takes, SampleSet& set);

}  // namespace panache
