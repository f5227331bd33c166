#pragma once
// How much the user wants of what a style does: --posture, --dynamics, --timing and --region.

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/result.h"
#include "style/shape.h"

namespace panache::cli {

struct ShapeFlags {
  Shape shape;                       // All but the regions.
  std::vector<std::string> regions;  // As typed: "legs=0.5".
};

// Gives `verb` the four options; `flags` must outlive it.
void add_shape_options(CLI::App& verb, ShapeFlags& flags);

// The shape with its regions. Fails with a message where one is unknown, out of range or given
// twice.
Result<Shape> read_shape(const ShapeFlags& flags);

}  // namespace panache::cli
