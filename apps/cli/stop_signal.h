#pragma once
// Programs that run until they are told to end.

namespace panache::cli {

// From now on SIGINT and SIGTERM do not end the program, but are remembered.
void watch_stop_signals();
// Whether one has come.
bool stop_asked();

}  // namespace panache::cli
