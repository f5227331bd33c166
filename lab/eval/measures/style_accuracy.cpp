#include "eval/measures/table.h"

namespace panache {

constinit const Measure measure::style_accuracy = {
    "style_accuracy",
    "style",
    3,
    Better::higher,
    "Share of windows of about one second that a classifier, trained on real motion, "
    "recognises as the asked style.",
    [](const TakeEvidence& of) { return of.style_windows; },
    mean_of_windows,
};

}  // namespace panache
