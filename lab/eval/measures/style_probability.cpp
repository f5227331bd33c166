#include "eval/measures/table.h"

namespace panache {

constinit const Measure measure::style_probability = {
    "style_probability",
    "style probability",
    3,
    Better::higher,
    "Mean probability that the style classifier gives to the asked style.",
    [](const TakeEvidence& of) { return of.style_probability; },
    mean_of_windows,
};

}  // namespace panache
