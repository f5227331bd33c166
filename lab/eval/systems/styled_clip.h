#pragma once
// What a system made of an input, as the judge wants it.

#include <string>
#include <vector>

#include "eval/system.h"

namespace panache {

// `output`: on the input's skeleton and at its rate; `source_frames`: the input's frame
// (fractional) per frame of it.
RunResult styled_result(const TestInput& input, const std::string& style, const Clip& output,
                        const std::vector<double>& source_frames);

}  // namespace panache
