#pragma once
// The verbs of panache. A further one is a source file with its add_ function, and a line here.

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

// add_stylize() and so on: each makes its subcommand; running that sets `exit_code`. In a build
// without the library that a verb needs, the verb exists and says so.
#define PANACHE_DECLARE_VERB(name) void add_##name(CLI::App& app, int& exit_code);
PANACHE_VERBS(PANACHE_DECLARE_VERB)
#undef PANACHE_DECLARE_VERB

// A verb of live: the function runs it, once it is parsed, and returns the exit code.
std::function<int()> add_send(CLI::App& live);

}  // namespace panache::cli
