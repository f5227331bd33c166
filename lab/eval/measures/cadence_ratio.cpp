#include "eval/measures/table.h"
#include "eval/motion_metrics.h"

namespace panache {

// NOLINTNEXTLINE(cert-err58-cpp): constinit, so that nothing runs before main.
constinit const Measure measure::cadence_ratio = {
    "cadence_ratio",
    "cadence / real",
    2,
    Better::nearest_one,
    "Steps a second of walks and runs, as a ratio to real takes of the style.",
    [](const TakeEvidence& of) { return cadence(*of.take); },
    mean_against_real,
};

}  // namespace panache
