#include "eval/measures/table.h"

namespace panache {

constinit const Measure measure::fmd = {
    "fmd",
    "FMD",
    2,
    Better::lower,
    "Fr\xc3\xa9"
    "chet distance of the content classifier's features, output against real takes of the "
    "asked style and content; comparable only within this page.",
    nullptr,
    [](const CellEvidence& of) { return of.feature_distance; },
};

}  // namespace panache
