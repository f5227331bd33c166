#pragma once
// The options that take a style off the input, shared by stylize and live.

#include <optional>
#include <string>

#include <CLI/CLI.hpp>

#include "messages.h"
#include "style/removal.h"

namespace panache::cli {

struct RemovalFlags {
  std::string style;     // --remove, or empty.
  bool neutral = false;  // --neutral
  std::string remover;   // --remover, or empty.

  bool given() const { return neutral || !style.empty(); }
};
// `flags` must outlive the verb.
void add_removal_options(CLI::App& verb, RemovalFlags& flags);

// What to take off; absent where nothing is to be. Throws Failure.
std::optional<Removal> read_removal(const RemovalFlags& flags);

// "old off", or "neutral" where the style has no name.
std::string describe(const Removal& removal);
// The name of the style that is taken off; null without one.
Json removed_json(const std::optional<Removal>& removal);

}  // namespace panache::cli
