#pragma once
// Where results go.

#include <string>
#include <vector>

#include "base/result.h"

namespace panache::cli {

// The output file of each input. `output` is a folder where there are several inputs, where it ends
// in '/' and where it is one; files in it are called as the inputs. Two inputs with one output are
// refused.
Result<std::vector<std::string>> name_outputs(const std::vector<std::string>& inputs,
                                              const std::string& output);

// Refuses an output that exists, or is the very input, unless `force`: before any work is done for
// it.
Result<void> check_output(const std::string& input, const std::string& output, bool force);

}  // namespace panache::cli
