#pragma once
// How well a style is learnt from one clip of it: with a neutral clip of the performer, and
// without.

#include <map>
#include <string>
#include <vector>

#include "base/result.h"
#include "learn/neutral_bank.h"
#include "learn/take.h"
#include "net/safetensors.h"

namespace panache {

// Means over styles of the mean distance of the joints from a real take, cm on the canonical body.
struct LearningErrors {
  int styles = 0;
  double none = 0;                              // Of the neutral motion.
  double posture = 0;                           // With the mean posture of the pair.
  double pair = 0;                              // With the style learnt from the pair.
  double alone = 0;                             // With the style learnt from the styled clip alone.
  double seconds = 0;                           // That learning alone took.
  double certainty = 0, people = 0, known = 0;  // See TwinFacts.
};

// By action, of the styled training takes that have a neutral one of their performer. Judged on the
// performer's test takes of style and action. An action without test takes is judged on its
// training takes, as "run, same take". `takes`: in layout positions.
Result<std::map<std::string, LearningErrors>> measure_learning(const TensorFile& model,
                                                               const NeutralBank& bank,
                                                               const std::vector<Take>& takes);

}  // namespace panache
