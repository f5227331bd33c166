#pragma once
// Three hundred styled frames as one number, to compare machines by.

#include <cstdint>
#include <memory>

#include "style/model.h"

namespace panache::web {

// A figure marches on the spot and forward, made of nothing but arithmetic that is the same
// everywhere, and goes from the model's first style over all others to its last. The hash (FNV-1a)
// is of the bits of all joints of the 300 frames that a Stylizer makes of it; 0 where it cannot.
uint64_t golden_hash(std::shared_ptr<const Model> model);

}  // namespace panache::web
