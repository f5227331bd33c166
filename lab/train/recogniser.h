#pragma once
// Style recognition of a remover: a linear layer on statistics of its trunk.

#include <string>
#include <vector>

#include "base/result.h"
#include "learn/take.h"
#include "net/safetensors.h"

namespace panache {

// Adds the tensors of Model::Recognition to a model file. The classes are the styles of the model
// and neutral, named as in the rows of the takes. Fails if the file is not a model.
Result<void> add_recognition(const std::vector<Take>& takes, uint64_t seed, TensorFile& file);

}  // namespace panache
