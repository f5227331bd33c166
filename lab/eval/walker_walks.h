#pragma once
// Walks of the program's own walker as inputs of an evaluation.

#include <string>
#include <vector>

#include "base/result.h"
#include "eval/test_input.h"

namespace panache {

// Straight walks at a slow, a usual and a brisk speed; `walker_model`: a file.
Result<std::vector<TestInput>> walker_walks(const std::string& walker_model);

}  // namespace panache
