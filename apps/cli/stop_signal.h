#pragma once
// Handles Ctrl-C for work that needs to clean up.

namespace panache::cli {

// From now on the first SIGINT or SIGTERM is only recorded. A second one ends the program.
void watch_stop_signals();
// Whether a signal was recorded.
bool stop_asked();

}  // namespace panache::cli
