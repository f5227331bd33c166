#pragma once
// The options that stylize and live share: how much the user wants of what a style does (--posture,
// --dynamics, --timing, --region and --gestures), and the style that is taken off the input
// (--remove, --neutral and --remover).

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "messages.h"
#include "style/removal.h"
#include "style/stylizer.h"

namespace panache::cli {

struct ShapeFlags {
  Shape shape;                       // All but regions and timing.
  std::string timing = "steps";      // As typed.
  std::vector<std::string> regions;  // As typed: "legs=0.5".
  float gestures = 0;                // Per second, at random.
};

// Gives `verb` the five options; `flags` must outlive it.
void add_shape_options(CLI::App& verb, ShapeFlags& flags);

// Writes the shape, where the style has its tempo and the rate of gestures to `how`. Fails with a
// message where a region is unknown, out of range or given twice, or the timing is unknown.
Result<void> read_shape(const ShapeFlags& flags, StylizerOptions& how);

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
