#include "eval/measures/table.h"
#include "eval/motion_metrics.h"

namespace panache {

// NOLINTNEXTLINE(cert-err58-cpp): constinit, so that nothing runs before main.
constinit const Measure measure::jerk_ratio = {
    "jerk_ratio",
    "jerk / real",
    2,
    Better::nearest_one,
    "Mean magnitude of the third difference of the joints' positions, as a ratio "
    "to real takes of the same style and content; 1 is as smooth as real motion.",
    [](const TakeEvidence& of) { return mean_jerk(*of.take); },
    mean_against_real,
};

}  // namespace panache
