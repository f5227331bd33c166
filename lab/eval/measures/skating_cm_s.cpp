#include "eval/measures/table.h"
#include "eval/motion_metrics.h"

namespace panache {

// NOLINTNEXTLINE(cert-err58-cpp): constinit, so that nothing runs before main.
constinit const Measure measure::skating_cm_s = {
    "skating_cm_s",
    "slide cm/s",
    2,
    Better::lower,
    "Mean horizontal speed of ankles and toes, weighted from 1 at the floor to 0 at "
    "2.5 cm above it.",
    [](const TakeEvidence& of) { return 100 * weighted_skating(*of.take); },
    mean_of_takes,
};

}  // namespace panache
