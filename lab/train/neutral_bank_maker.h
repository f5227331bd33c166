#pragma once
// Makes the bank of neutral motion (see NeutralBank) from neutral takes of many people.

#include <cstdint>
#include <vector>

#include "learn/take.h"
#include "net/safetensors.h"

namespace panache {

struct MadeBank {
  TensorFile file;
  size_t prototypes = 0, people = 0;
};

// Takes are in layout positions, from files named PERSON_TAKE. Manifests weigh alike, people by the
// square root of their amount of motion, and gaits more than other actions. Needs at least
// NeutralBank::kMinPeople people.
MadeBank make_neutral_bank(const std::vector<Take>& takes, uint64_t seed);

}  // namespace panache
