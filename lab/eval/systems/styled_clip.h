#pragma once
// Converts the output of restyle() for evaluation.

#include <string>

#include "eval/system.h"
#include "style/restyle.h"

namespace panache {

RunResult styled_result(const TestInput& input, const std::string& style, const Restyled& output);

}  // namespace panache
