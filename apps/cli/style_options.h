#pragma once
// Options shared by stylize and live: how much of a style's effects to use (--posture, --dynamics,
// --timing, --region, --contacts and --gestures), the energy of the input (--energy), and the style
// to remove from the input (--remove, --neutral and --remover).

#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "messages.h"
#include "style/play/removal.h"
#include "style/stylizer.h"

namespace panache::cli {

struct ShapeFlags {
  Shape shape;                       // All except regions and timing.
  std::string timing = "steps";      // As typed.
  std::vector<std::string> regions;  // As typed: "legs=0.5".
  float gestures = 1;                // See StylizerOptions::gesture_rate.
};

// Gives `verb` these options; `flags` must outlive it.
void add_shape_options(CLI::App& verb, ShapeFlags& flags);

// Writes the shape, the timing mode and the gesture rate to `stylizer`. Fails if a region is
// unknown, out of range or repeated, or if the timing is unknown.
Result<void> read_shape(const ShapeFlags& flags, StylizerOptions& stylizer);

struct RemovalFlags {
  std::string style;     // --remove, or empty.
  bool neutral = false;  // --neutral
  std::string remover;   // --remover, or empty.

  bool given() const { return neutral || !style.empty(); }
};
// `flags` must outlive the verb.
void add_removal_options(CLI::App& verb, RemovalFlags& flags);

// The style to remove, if any. Throws Failure.
std::optional<Removal> read_removal(const RemovalFlags& flags);

// "old off", or "neutral" if no style is named.
std::string describe(const Removal& removal);
// The name of the removed style; null if there is none.
Json removed_json(const std::optional<Removal>& removal);

}  // namespace panache::cli
