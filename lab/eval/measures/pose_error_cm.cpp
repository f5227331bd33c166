#include "eval/measures/table.h"

namespace panache {

constinit const Measure measure::pose_error_cm = {
    "pose_error_cm",
    "error cm",
    2,
    Better::lower,
    "Mean distance of the joints from those of the time-aligned real styled take, on "
    "the canonical body.",
    nullptr,
    [](const CellEvidence& of) { return of.aligned ? of.aligned->cm : kNotMeasured; },
};

}  // namespace panache
