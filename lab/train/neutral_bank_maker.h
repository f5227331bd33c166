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

// From takes in layout positions, whose files are called PERSON_TAKE. The manifests weigh alike,
// people by the square root of what there is of them, and gaits more than the rest. At least
// NeutralBank::kMinPeople people.
MadeBank make_neutral_bank(const std::vector<Take>& takes, uint64_t seed);

}  // namespace panache
