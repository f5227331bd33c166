#pragma once
// Declares the measures of table.inc, each defined in a file of its own.

#include "eval/measure.h"

namespace panache::measure {

#define MEASURE(key) extern const Measure key;
#include "eval/measures/table.inc"
#undef MEASURE

}  // namespace panache::measure
