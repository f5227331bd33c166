#pragma once
// How much the user wants of what a style does: --posture, --dynamics, --timing, --region
// and --gestures.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/result.h"
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

}  // namespace panache::cli
