#pragma once
// The verbs of panache-lab. To add one, add a source file with its add_ function and a line here.

#include <CLI/CLI.hpp>

// In the order of --help.
// clang-format off
#define PANACHE_LAB_VERBS(verb) \
  verb(train) \
  verb(eval) \
  verb(bench) \
  verb(strip) \
  verb(gestures) \
  verb(quantize) \
  verb(export) \
  verb(fit_walker) \
  verb(neutral_bank) \
  verb(fit_persons) \
  verb(persons) \
  verb(learning) \
  verb(arrival) \
  verb(outputs)
// clang-format on

namespace panache::cli {

// add_train() and so on: each creates its subcommand, which sets `exit_code` when run.
#define PANACHE_DECLARE_VERB(name) void add_##name(CLI::App& app, int& exit_code);
PANACHE_LAB_VERBS(PANACHE_DECLARE_VERB)
#undef PANACHE_DECLARE_VERB

}  // namespace panache::cli
