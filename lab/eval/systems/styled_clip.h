#pragma once
// What a system made of an input, as the judge wants it.

#include <string>

#include "eval/system.h"
#include "style/restyle.h"

namespace panache {

RunResult styled_result(const TestInput& input, const std::string& style, const Restyled& output);

}  // namespace panache
