#pragma once
// Hashes three hundred styled frames, to compare results between machines.

#include <cstdint>
#include <memory>

#include "style/model/model.h"

namespace panache::web {

// The input is a figure that marches, generated with arithmetic that is the same on all machines.
// It passes through all styles of the model, first to last. The result is the FNV-1a hash of the
// bits of all joints in the 300 frames that a Stylizer outputs; 0 on failure.
uint64_t golden_hash(std::shared_ptr<const Model> model);

}  // namespace panache::web
