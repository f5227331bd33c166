#include "eval/measures/table.h"

namespace panache {

constinit const Measure measure::pose_error_deg = {
    "pose_error_deg",
    "error deg",
    2,
    Better::lower,
    "Mean angle between the local rotations of the joints and those of the "
    "time-aligned real styled take.",
    nullptr,
    [](const CellEvidence& of) { return of.aligned ? of.aligned->degrees : kNotMeasured; },
};

}  // namespace panache
