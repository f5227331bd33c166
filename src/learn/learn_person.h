#pragma once
// The numbers of a person (style/model/person.h) from neutral motion of that person.

#include <memory>
#include <span>
#include <vector>

#include "base/result.h"
#include "learn/neutral_bank.h"
#include "learn/pairing.h"
#include "learn/take.h"
#include "style/model/model.h"
#include "style/model/person.h"

namespace panache {

// A person's take and what other people do at the same moments: takes[0] is theirs, takes[1] the
// person's. Empty if the bank knows no such motion, or if the two match badly.
struct PersonMatch {
  std::vector<Take> takes;
  std::vector<Pairing> pairings;
};
// `take`: in layout positions; up to ten seconds from its middle are used.
PersonMatch match_person(const NeutralBank& bank, const Take& take);

struct LearntPerson {
  PersonNumbers numbers{};
  double seconds = 0;    // Of matched motion.
  double explained = 0;  // Share of the difference from other people that the numbers carry.
};

// The numbers that fit takes of one person best, near to the mean person where they say little.
// Fails if the model has no persons, or if no take shows what others do, too.
Result<LearntPerson> learn_person(const std::shared_ptr<const Model>& model,
                                  const NeutralBank& bank, std::span<const Take> takes);

}  // namespace panache
