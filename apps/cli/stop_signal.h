#pragma once
// Ctrl-C, for work that has to leave things in order.

namespace panache::cli {

// From now on the first SIGINT or SIGTERM does not end the program, but is remembered. A second one
// ends it.
void watch_stop_signals();
// Whether one has come.
bool stop_asked();

}  // namespace panache::cli
