#pragma once
// Draws motions as rows of stick figures, for reports and documentation.

#include <string>
#include <vector>

#include "rig/humanoid.h"

namespace panache {

struct StripRow {
  std::string label;  // Long labels are wrapped.
  // World space, metres; spaced by StripOptions::seconds_between. Non-finite figures are left out.
  std::vector<HumanPositions> frames;
  std::string colour;  // "#rrggbb"; empty for a default.
};

struct StripOptions {
  std::string title;
  double seconds_between = 0.25;  // Between frames, for the labels.
  // Rotation of the figures from the side view towards the viewer (90: they approach), and downward
  // tilt of the camera; degrees. Each row is viewed relative to its direction of travel, or its
  // mean heading if it goes nowhere or elsewhere.
  double yaw_deg = 32, pitch_deg = 8;
  double pixels_per_metre = 84;
  // Places each figure at its position on a ground marked in metres, instead of at equal distances.
  // Rows share one scale, so a slower walk is a shorter row. Half a second between figures keeps
  // those of a walk from overlapping.
  bool travel = false;
};

// An SVG file. The body's right side is drawn in full colour, its left in a lighter one.
std::string draw_strip(const std::vector<StripRow>& rows, const StripOptions& options);

}  // namespace panache
