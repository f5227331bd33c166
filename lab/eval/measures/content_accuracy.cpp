#include "eval/measures/table.h"

namespace panache {

constinit const Measure measure::content_accuracy = {
    "content_accuracy",
    "content",
    3,
    Better::higher,
    "Share of windows that a second classifier recognises as the input's content.",
    [](const TakeEvidence& of) { return of.content_windows; },
    mean_of_windows,
};

}  // namespace panache
