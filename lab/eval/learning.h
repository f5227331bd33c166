#pragma once
// Measures how well a style is learnt from one clip, with and without a neutral clip of the
// performer.

#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "learn/neutral_bank.h"
#include "learn/take.h"
#include "net/safetensors.h"

namespace panache {

// Means over styles of the mean joint distance to a real take, cm on the canonical body.
struct LearningErrors {
  int styles = 0;
  double none = 0;                              // Of the neutral motion.
  double posture = 0;                           // With the mean posture of the pair.
  double pair = 0;                              // With the style learnt from the pair.
  double alone = 0;                             // With the style learnt from the styled clip alone.
  double seconds = 0;                           // Time of learning alone.
  double certainty = 0, people = 0, known = 0;  // See TwinFacts.
};

// Results by action, for styled training takes with a neutral take of their performer. Evaluated on
// the performer's test takes of style and action; without any, on the training takes, as "run, same
// take". `takes`: in layout positions.
Result<std::map<std::string, LearningErrors>> measure_learning(const TensorFile& model,
                                                               const NeutralBank& bank,
                                                               const std::vector<Take>& takes);

}  // namespace panache
