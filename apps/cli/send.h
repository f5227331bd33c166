#pragma once
// panache live send: plays a motion file as a tracker would send it (VMC protocol).

#include <functional>

#include <CLI/CLI.hpp>

namespace panache::cli {

// Adds the subcommand to that of live. The function runs it, once it is parsed, and returns the
// exit code.
std::function<int()> add_send(CLI::App& live);

}  // namespace panache::cli
