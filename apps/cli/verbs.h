#pragma once
// The verbs of panache. To add one, add a source file with its add_ function, and a line here.

#include <functional>

#include <CLI/CLI.hpp>

// In the order of --help.
// clang-format off
#define PANACHE_VERBS(verb) \
  verb(stylize) \
  verb(learn) \
  verb(retarget) \
  verb(convert) \
  verb(info) \
  verb(styles) \
  verb(walker) \
  verb(live) \
  verb(view)
// clang-format on

namespace panache::cli {

// add_stylize() and so on: each adds its subcommand, which sets `exit_code` when run. In a build
// without a required library, the verb exists and reports that.
#define PANACHE_DECLARE_VERB(name) void add_##name(CLI::App& app, int& exit_code);
PANACHE_VERBS(PANACHE_DECLARE_VERB)
#undef PANACHE_DECLARE_VERB

// A nested verb of live: the returned function runs it after parsing and returns the exit code.
std::function<int()> add_send(CLI::App& live);

}  // namespace panache::cli
