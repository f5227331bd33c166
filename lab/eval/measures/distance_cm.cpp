#include "eval/measures/table.h"
#include "eval/motion_metrics.h"

namespace panache {

// NOLINTNEXTLINE(cert-err58-cpp): constinit, so that nothing runs before main.
constinit const Measure measure::distance_cm = {
    "distance_cm",
    "moved cm",
    2,
    Better::neither,
    "Mean distance of the joints from the input's: how much was changed, not how "
    "well.",
    [](const TakeEvidence& of) {
      // Nothing to measure where nobody knows which instant of the input a frame shows.
      if (!of.input || of.source_frames->empty()) return kNotMeasured;
      return 100 * mean_distance(*of.take, *of.input, *of.source_frames);
    },
    mean_of_takes,
};

}  // namespace panache
