#include "eval/measures/table.h"
#include "eval/motion_metrics.h"

namespace panache {

// NOLINTNEXTLINE(cert-err58-cpp): constinit, so that nothing runs before main.
constinit const Measure measure::skating_ratio = {
    "skating_ratio",
    "skating",
    3,
    Better::lower,
    "Share of frames in which a toe is below 5 cm in two neighbouring frames and "
    "slides faster than 0.5 m/s, at 20 frames a second.",
    [](const TakeEvidence& of) { return panache::skating_ratio(*of.take); },
    mean_of_takes,
};

}  // namespace panache
